// Tests that draw are skipped only where no OpenGL context can be had at all.
#pragma once

#include <gtest/gtest.h>

#include "base/error.h"
#include "player/gl_context.h"

namespace lucarne::test {

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      const HeadlessGl gl;
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

}  // namespace lucarne::test
