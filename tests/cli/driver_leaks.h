// OpenGL drivers leak when they are unloaded; leaks of ours show in the other tests.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace lucarne::test {

/// Programs started while it lives do not look for leaks at their end.
class DriverLeaksAllowed {
 public:
  DriverLeaksAllowed() {
    if (const char* before = std::getenv(kName)) before_ = before;
    ::setenv(kName, "detect_leaks=0", 1);
  }
  ~DriverLeaksAllowed() {
    if (before_) {
      ::setenv(kName, before_->c_str(), 1);
    } else {
      ::unsetenv(kName);
    }
  }
  DriverLeaksAllowed(const DriverLeaksAllowed&) = delete;
  DriverLeaksAllowed& operator=(const DriverLeaksAllowed&) = delete;

 private:
  static constexpr const char* kName = "ASAN_OPTIONS";
  std::optional<std::string> before_;
};

}  // namespace lucarne::test
