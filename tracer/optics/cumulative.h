// Inversion of a discrete distribution: a cumulative table with a guide (Chen and Asau 1974, "On generating random
// variates from an empirical distribution"). O(1) expected, order-preserving: a larger number never gives an earlier
// choice. The tables lie in the caller's memory, so that the rows of an image share two blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lucarne {

/// Turns weights ≥ 0 in place into their cumulative sum divided by the total, which is returned; the last is then 1.
/// All stay 0 where the total is 0.
inline double makeCumulative(std::span<double> weights) {
  double total = 0;
  for (double& w : weights) w = total += w;
  if (total > 0)
    for (double& w : weights) w /= total;
  return total;
}

/// guide[k] = first i with cumulative[i] > k/size; as long as the cumulative table.
inline void makeGuide(std::span<const double> cumulative, std::span<std::uint32_t> guide) {
  const std::size_t n = cumulative.size();
  std::uint32_t i = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = static_cast<double>(k) / static_cast<double>(n);
    while (i + 1 < n && cumulative[i] <= u) ++i;
    guide[k] = i;
  }
}

struct Choice {
  std::size_t index;
  double rest;  // where u lies between the choice's ends, in [0, 1): as good as a fresh number
};

/// u in [0, 1). A choice of weight 0 is never made, if the total was positive.
inline Choice choose(std::span<const double> cumulative, std::span<const std::uint32_t> guide, double u) {
  const std::size_t n = cumulative.size();
  std::size_t i = guide[std::min(static_cast<std::size_t>(u * static_cast<double>(n)), n - 1)];
  // Where a choice begins: 0, or the end of the one before. Without a branch, which could not be foretold.
  const auto begin = [&](std::size_t k) { return cumulative[k - (k > 0)] * static_cast<double>(k > 0); };
  while (begin(i) > u) --i;  // u·n may have been rounded up to the next entry of the guide
  while (cumulative[i] <= u && i + 1 < n) ++i;
  const double lo = begin(i);
  constexpr double kBelowOne = 1 - 0x1p-53;
  return {i, std::min((u - lo) / (cumulative[i] - lo), kBelowOne)};
}

}  // namespace lucarne
