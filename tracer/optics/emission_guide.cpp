#include "tracer/optics/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace lucarne {
namespace {

constexpr double kUniformShare = 0.25;
constexpr std::uint32_t kMean = 1u << 16;  // weight of a cell of the uniform density
constexpr float kBelowOne = 1 - 0x1p-24f;

std::uint32_t cellAt(float u, std::uint32_t n) {
  return std::min(static_cast<std::uint32_t>(u * static_cast<float>(n)), n - 1);
}

/// Chooses among n weights by inversion of u: index, and where u lies in it.
std::pair<std::size_t, float> invert(const std::uint64_t* weights, std::uint32_t n, float u) {
  const std::uint64_t total = std::accumulate(weights, weights + n, std::uint64_t{0});
  const double at = static_cast<double>(u) * static_cast<double>(total);
  std::uint64_t below = 0;
  std::size_t i = 0;
  while (i + 1 < n && static_cast<double>(below + weights[i]) <= at) below += weights[i++];
  const double rest = (at - static_cast<double>(below)) / static_cast<double>(weights[i]);
  return {i, static_cast<float>(rest)};
}

}  // namespace

EmissionGuide::EmissionGuide(GuideGrid grid, std::span<const double> usefulness) : grid_(grid) {
  LUCARNE_CHECK_EQ(usefulness.size(), grid.cells());
  const double total = std::accumulate(usefulness.begin(), usefulness.end(), 0.0);
  const double scale = total > 0 ? static_cast<double>(usefulness.size()) / total : 0;
  for (const double useful : usefulness) {
    const double density = total > 0 ? kUniformShare + (1 - kUniformShare) * useful * scale : 1.0;
    weights_.push_back(static_cast<std::uint32_t>(std::llround(density * kMean)));
  }
  const std::array<std::uint32_t, 4> sizes{grid.direction, grid.direction, grid.place, grid.place};
  sums_[3].assign(weights_.begin(), weights_.end());
  for (std::size_t axis = 3; axis > 0; --axis) {
    const std::vector<std::uint64_t>& fine = sums_[axis];
    for (std::size_t i = 0; i < fine.size(); i += sizes[axis])
      sums_[axis - 1].push_back(std::accumulate(fine.begin() + static_cast<std::ptrdiff_t>(i),
                                                fine.begin() + static_cast<std::ptrdiff_t>(i + sizes[axis]),
                                                std::uint64_t{0}));
  }
  total_ = std::accumulate(sums_[0].begin(), sums_[0].end(), std::uint64_t{0});
}

EmissionGuide::Numbers EmissionGuide::warp(Vec2f direction, Vec2f place) const {
  const std::array<std::uint32_t, 4> sizes{grid_.direction, grid_.direction, grid_.place, grid_.place};
  std::array<float, 4> u{direction.x, direction.y, place.x, place.y};
  std::size_t prefix = 0;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const auto [i, rest] = invert(sums_[axis].data() + prefix * sizes[axis], sizes[axis], u[axis]);
    u[axis] = std::min((static_cast<float>(i) + rest) / static_cast<float>(sizes[axis]), kBelowOne);
    prefix = prefix * sizes[axis] + i;
  }
  return {{u[0], u[1]}, {u[2], u[3]}, densityOf(prefix)};
}

std::size_t EmissionGuide::cellOf(Vec2f direction, Vec2f place) const {
  return ((std::size_t{cellAt(direction.x, grid_.direction)} * grid_.direction + cellAt(direction.y, grid_.direction)) *
              grid_.place +
          cellAt(place.x, grid_.place)) *
             grid_.place +
         cellAt(place.y, grid_.place);
}

double EmissionGuide::densityOf(std::size_t cell) const {
  return static_cast<double>(weights_[cell]) * static_cast<double>(weights_.size()) / static_cast<double>(total_);
}

Hash128 EmissionGuide::hash() const {
  Hasher hasher;
  hasher.addNumber(grid_.direction);
  hasher.addNumber(grid_.place);
  for (const std::uint32_t w : weights_) hasher.addNumber(w);
  return hasher.finish();
}

}  // namespace lucarne
