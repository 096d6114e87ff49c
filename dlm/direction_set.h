// Ω: the global set of light directions, near-uniform on the sphere for any n ≥ 1, and its Voronoi cells.
//
// Construction: the n points of a spherical Fibonacci lattice (Swinbank and Purser 2006; offset ½) relaxed by a fixed number
// of Lloyd steps with exact cell centroids while n is small, then turned by a fixed generic rotation so that no ψ lies in the
// plane of an axis-aligned floor. ψ points away from the surface, toward the light.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace lucarne {

/// The part of a cell above a horizon: integrals over {ω in the cell, n·ω > 0}, ω unit, by solid angle.
struct ClippedCell {
  double solidAngle = 0;    // ∫ dω, sr
  Vec3d moment{};           // ∫ ω dω; its direction is the mean light direction
  double cosIntegral = 0;   // ∫ n·ω dω = n · moment, sr: the irradiance per unit of constant radiance
  double meanCosine() const { return solidAngle > 0 ? cosIntegral / solidAngle : 0; }
};

class DirectionSet {
 public:
  explicit DirectionSet(int count);  // 1 … 65535

  int count() const { return static_cast<int>(directions_.size()); }
  Vec3d direction(int psi) const { return directions_[static_cast<std::size_t>(psi)]; }
  const std::vector<Vec3d>& directions() const { return directions_; }

  /// The ψ with the largest dot product with `w` (float arithmetic, smallest index on a tie). Exact and O(1) on average.
  int nearest(Vec3f w) const;

  /// Exact integrals over the cell of ψ above the plane of unit normal `n`; closed forms over spherical polygons.
  ClippedCell clippedCell(int psi, Vec3d n) const;
  /// The whole cell.
  ClippedCell cell(int psi) const;
  /// True if the cell of ψ reaches above the horizon of `n` (by more than rounding).
  bool reaches(int psi, Vec3d n) const;

 private:
  struct Polygon {  // convex, on the unit sphere, counter-clockwise from outside
    std::vector<Vec3d> vertices;
  };
  void buildCells();
  void buildLookup();

  std::vector<Vec3d> directions_;
  std::vector<Vec3f> directionsF_;
  std::vector<std::vector<Polygon>> cells_;   // each clipped to the eight octants, so that all pieces are < a hemisphere
  int gridSize_ = 1;                          // octahedral grid of candidate lists
  std::vector<std::uint32_t> gridFirst_;
  std::vector<std::uint16_t> gridCandidates_;
};

}  // namespace lucarne
