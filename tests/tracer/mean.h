// Mean of numbers and its standard error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lucarne::test {

struct Mean {
  double sum = 0, squares = 0;
  std::uint64_t n = 0;
  void add(double x) {
    sum += x;
    squares += x * x;
    ++n;
  }
  double mean() const { return sum / static_cast<double>(n); }
  double error() const { return std::sqrt(variance() / static_cast<double>(n)); }
  double variance() const { return std::max(0.0, squares / static_cast<double>(n) - mean() * mean()); }
};

}  // namespace lucarne::test
