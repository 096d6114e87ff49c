#include "base/log.h"

#include <gtest/gtest.h>

namespace lucarne::log_test {
namespace {

TEST(Log, GoesToStderrOnlyAndTakesTextAsItIs) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  setUpLogging();
  logInfo("read {} %s");
  logWarning("dim");
  logError("broken");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "lucarne: read {} %s\nlucarne: warning: dim\nlucarne: broken\n");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Log, QuietLeavesErrors) {
  ::testing::internal::CaptureStderr();
  setUpLogging();
  setQuiet(true);
  logInfo("a");
  logWarning("b");
  logError("c");
  setQuiet(false);
  logInfo("d");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "lucarne: c\nlucarne: d\n");
}

}  // namespace
}  // namespace lucarne::log_test
