// Three kinds of wrong: a user's error is an `Error` with an exit code, caught once in main; a broken contract is a
// failed LUCARNE_CHECK (a std::logic_error that prints its operands); a library's own failure is translated at the edge.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace lucarne {

enum class ExitCode : int { done = 0, failed = 1, usage = 2, badInput = 3, mergeRefused = 4, outOfResource = 5, interrupted = 130 };

/// One line for the user: what, in which file, and the mend. No trailing full stop or newline.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A file that we cannot use as input: exit code 3.
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitCode::badInput, message) {}
};

/// Arguments that make no sense: exit code 2.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

namespace detail {
template <class A, class B>
[[noreturn]] void checkFailed(const char* expression, const char* file, int line, const A& a, const B& b) {
  std::ostringstream out;
  out << file << ":" << line << ": check failed: " << expression << " with " << a << " and " << b;
  throw std::logic_error(out.str());
}
}  // namespace detail

}  // namespace lucarne

/// Contract checks that stay on in release builds; they print both operands. The only macros of the project.
#define LUCARNE_CHECK_OP(a, op, b)                                                              \
  do {                                                                                          \
    const auto& lucarneA = (a);                                                                 \
    const auto& lucarneB = (b);                                                                 \
    if (!(lucarneA op lucarneB)) ::lucarne::detail::checkFailed(#a " " #op " " #b, __FILE__, __LINE__, lucarneA, lucarneB); \
  } while (false)
#define LUCARNE_CHECK_EQ(a, b) LUCARNE_CHECK_OP(a, ==, b)
#define LUCARNE_CHECK_LE(a, b) LUCARNE_CHECK_OP(a, <=, b)
#define LUCARNE_CHECK_LT(a, b) LUCARNE_CHECK_OP(a, <, b)
