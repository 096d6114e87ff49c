// Expecting one of our errors by its exit code, and looking at its text.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"

namespace lucarne {

/// The message of the Error that `action` must throw with `code`; a test failure and "" when it does not.
template <class Action>
std::string errorOf(ExitCode code, Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_FALSE(text.ends_with('.')) << text;
    return text;
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace lucarne
