#include "player/render_scale.h"

#include <gtest/gtest.h>

namespace lucarne::render_scale_test {
namespace {

TEST(RenderScale, SlowMotionIsDrawnCoarserAndRestInFull) {
  RenderScale scale(0.8);
  for (int i = 0; i < 20; ++i) scale.update(0.1, true);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.4);
  scale.update(0.1, false);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.4);
  for (int i = 0; i < 5; ++i) scale.update(0.1, false);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.8);
  for (int i = 0; i < 20; ++i) scale.update(0.001, true);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.8);
}

}  // namespace
}  // namespace lucarne::render_scale_test
