// Ω: the global set of light directions, near-uniform on the sphere for any n ≥ 1, and its Voronoi cells.
//
// Construction: the n points of a spherical Fibonacci lattice (Swinbank and Purser 2006; offset ½) relaxed by a fixed
// number of Lloyd steps with exact cell centroids while n is small, then turned by the rotation, of a fixed sequence,
// that keeps them farthest from the planes of axis-aligned floors and walls. Plain arithmetic only: the same bits on
// every machine. ψ points away from the surface, toward the light.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "dlm/spherical_polygon.h"

namespace lucarne {

/// The part of a cell above a horizon: integrals over {ω in the cell, n·ω > 0}, ω unit, by solid angle.
struct ClippedCell {
  double solidAngle = 0;   // ∫ dω, sr
  Vec3d moment{};          // ∫ ω dω; its direction is the mean light direction
  double cosIntegral = 0;  // ∫ n·ω dω = n · moment, sr: the irradiance per unit of constant radiance
  double meanCosine() const { return solidAngle > 0 ? cosIntegral / solidAngle : 0; }
};

class DirectionSet {
 public:
  explicit DirectionSet(int count);  // 1 … 65535

  int count() const { return static_cast<int>(directions_.size()); }
  Vec3d direction(int psi) const { return directions_[static_cast<std::size_t>(psi)]; }
  const std::vector<Vec3d>& directions() const { return directions_; }

  /// The ψ with the largest dot product with `w` (float arithmetic, smallest index on a tie). Exact and O(1) on
  /// average.
  [[gnu::always_inline]] int nearest(Vec3f w) const {
    const float sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
    if (!(sum > 0) || !std::isfinite(sum)) return 0;
    const float perSum = 1 / sum;
    const float qx = w.x * perSum, qy = w.y * perSum;
    const float fx = std::copysign(1 - std::abs(qy), qx), fy = std::copysign(1 - std::abs(qx), qy);
    const std::uint32_t lower = 0u - (std::bit_cast<std::uint32_t>(w.z) >> 31);  // no branch: it could not be foretold
    const float px = choose(lower, fx, qx), py = choose(lower, fy, qy);
    const float half = 0.5f * static_cast<float>(gridSize_);
    const int x = std::min(std::max(static_cast<int>((px + 1) * half), 0), gridSize_ - 1);
    const int y = std::min(std::max(static_cast<int>((py + 1) * half), 0), gridSize_ - 1);
    const auto cell = static_cast<std::size_t>(y * gridSize_ + x);
    // Nearly all cells have one or two candidates; of two the nearer is told without a branch.
    const auto [first, second] = two_[cell];
    if (first == kSeveral) [[unlikely]]
      return nearestOfSeveral(cell, w);
    return first + (second - first) * static_cast<int>(dot(directionsF_[second], w) > dot(directionsF_[first], w));
  }

  /// Exact integrals over the cell of ψ above the plane of unit normal `n`; closed forms over spherical polygons.
  ClippedCell clippedCell(int psi, Vec3d n) const;
  /// ∫ ω (n·ω) dω over the same part: divided by cosIntegral, the mean direction of what constant light brings, as
  /// mean_direction.h has it.
  Vec3d cosineMoment(int psi, Vec3d n) const;
  /// The whole cell.
  ClippedCell cell(int psi) const;
  /// True if the cell of ψ reaches above the horizon of `n` (by more than rounding).
  bool reaches(int psi, Vec3d n) const;

 private:
  struct Piece {                 // a convex part of a cell, smaller than a hemisphere
    std::uint32_t first, count;  // in vertices_
    SphericalIntegral whole;
  };
  struct Cell {
    SphericalIntegral whole;
    double coneSine;  // sine of the cell's radius about ψ; 2 if that is not below 90 degrees
  };
  static constexpr std::uint16_t kSeveral = 0xffff;
  /// `a` where all bits of the mask are set, `b` where none is.
  static float choose(std::uint32_t mask, float a, float b) {
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) | (std::bit_cast<std::uint32_t>(b) & ~mask));
  }
  int nearestOfSeveral(std::size_t cell, Vec3f w) const;
  void buildCells();
  void buildLookup();
  SphericalIntegral above(int psi, Vec3d n) const;

  std::vector<Vec3d> directions_;
  std::vector<Vec3f> directionsF_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> firstPiece_;  // of each ψ, into pieces_, and the end
  std::vector<Piece> pieces_;              // each cell clipped to the eight octants
  std::vector<Vec3d> vertices_;
  int gridSize_ = 1;  // octahedral grid of candidate lists
  std::vector<std::uint32_t> gridFirst_;
  std::vector<std::uint16_t> gridCandidates_;
  std::vector<std::array<std::uint16_t, 2>> two_;  // by cell: its candidates, the one twice; kSeveral: more than two
};

}  // namespace lucarne
