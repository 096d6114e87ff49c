// The three ψ of Ω around a direction, and how much of it is each one's: barycentric weights in the triangles of the
// spherical Delaunay triangulation.
//
// In the triangle of ψ0, ψ1, ψ2 a direction is w = Σ μk ψk with μk ≥ 0, and its weights are μk/Σμ: those of the point
// where the ray along w meets the flat triangle. On an edge they depend on its two ends alone, so that they are
// continuous over the sphere; at ψ they are 1 and 0. μk = dk·w with d0 = ψ1 × ψ2/det(ψ0, ψ1, ψ2), the dual basis.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "dlm/octahedral_grid.h"

namespace lucarne {

/// Three ψ and the weight of each in units of 1/kWhole; the sum is kWhole exactly.
struct DirectionWeights {
  static constexpr std::uint32_t kWhole = 1u << 16;
  std::array<std::uint16_t, 3> psi{};
  std::array<std::uint32_t, 3> weight{kWhole, 0, 0};
};

class DirectionTriangles {
 public:
  struct Triangle {
    std::array<Vec3f, 3> dual;
    std::array<std::uint32_t, 3> across;  // the triangle beyond the edge opposite ψk
    std::array<std::uint16_t, 3> psi;     // counter-clockwise seen from outside
  };

  /// `directions`: 4 … 65535 unit vectors around the origin, such as those of a DirectionSet.
  explicit DirectionTriangles(const std::vector<Vec3d>& directions);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// For any length of `w`; of what has no direction (zero, not finite) all is one ψ's. O(1) on average, and the same
  /// bits on every machine.
  [[gnu::always_inline]] DirectionWeights around(Vec3f w) const {
    const int cell = octahedralCell(w, gridSize_);
    if (cell < 0) return {};
    std::uint32_t t = start_[static_cast<std::size_t>(cell)];
    // A step across the edge that w is farthest beyond; in a Delaunay triangulation such a walk ends. From the triangle
    // of the middle of the cell it is mostly there, or one step off.
    for (int step = 0;; ++step) {
      const Triangle& at = triangles_[t];
      const float a = dot(at.dual[0], w), b = dot(at.dual[1], w), c = dot(at.dual[2], w);
      const float least = std::min(std::min(a, b), c);
      if (least >= -kSlack * (a + b + c) || step == kMostSteps) [[likely]]
        return weights(at, a, b, c);
      t = at.across[least == a ? 0 : least == b ? 1 : 2];
    }
  }

 private:
  // Beyond an edge by rounding alone: two triangles would else send w to and fro. Below half a unit of weight.
  static constexpr float kSlack = 4e-6f;
  static constexpr int kMostSteps = 1 << 10;

  static DirectionWeights weights(const Triangle& at, float a, float b, float c) {
    const float sum = a + b + c, scale = static_cast<float>(DirectionWeights::kWhole) / sum;
    if (!(sum > 0) || !std::isfinite(scale)) return {at.psi, {DirectionWeights::kWhole, 0, 0}};
    // Running sums, each rounded to nearest.
    const std::uint32_t first = toUnits(a * scale), second = std::max(first, toUnits((a + b) * scale));
    return {at.psi, {first, second - first, DirectionWeights::kWhole - second}};
  }
  static std::uint32_t toUnits(float v) {
    return static_cast<std::uint32_t>(std::clamp(v + 0.5f, 0.f, static_cast<float>(DirectionWeights::kWhole)));
  }

  std::vector<Triangle> triangles_;
  int gridSize_;
  std::vector<std::uint32_t> start_;  // by grid cell: the triangle of its middle
};

}  // namespace lucarne
