// A grid over the sphere: the octahedron |x| + |y| + |z| = 1 laid out on the square [-1, 1]², cut into size × size
// cells.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/vec.h"

namespace lucarne {

namespace detail {
/// `a` where all bits of the mask are set, `b` where none is.
inline float choose(std::uint32_t mask, float a, float b) {
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) | (std::bit_cast<std::uint32_t>(b) & ~mask));
}
}  // namespace detail

/// The cell, row by row, that holds the direction of `w`; −1 for what has none (zero, not finite).
[[gnu::always_inline]] inline int octahedralCell(Vec3f w, int size) {
  const float sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
  if (!(sum > 0) || !std::isfinite(sum)) return -1;
  const float perSum = 1 / sum;
  const float qx = w.x * perSum, qy = w.y * perSum;
  const float fx = std::copysign(1 - std::abs(qy), qx), fy = std::copysign(1 - std::abs(qx), qy);
  const std::uint32_t lower = 0u - (std::bit_cast<std::uint32_t>(w.z) >> 31);  // no branch: it could not be foretold
  const float px = detail::choose(lower, fx, qx), py = detail::choose(lower, fy, qy);
  const float half = 0.5f * static_cast<float>(size);
  const int x = std::min(std::max(static_cast<int>((px + 1) * half), 0), size - 1);
  const int y = std::min(std::max(static_cast<int>((py + 1) * half), 0), size - 1);
  return y * size + x;
}

/// The unit vector at a point of the square; the inner diamond is the upper half (z >= 0), the corners fold down.
inline Vec3d octahedronPoint(double px, double py) {
  const double z = 1 - std::abs(px) - std::abs(py);
  if (z >= 0) return normalize(Vec3d{px, py, z});
  return normalize(Vec3d{std::copysign(1 - std::abs(py), px), std::copysign(1 - std::abs(px), py), z});
}

}  // namespace lucarne
