// Ω: the global set of light directions, near-uniform on the sphere for any n ≥ 1, and its Voronoi cells.
//
// Construction: the n points of a spherical Fibonacci lattice (Swinbank and Purser 2006; offset ½) relaxed by a fixed
// number of Lloyd steps with exact cell centroids while n is small, then turned by the rotation, of a fixed sequence,
// that keeps them farthest from the planes of axis-aligned floors and walls. Plain arithmetic only: the same bits on
// every machine. ψ points away from the surface, toward the light.
//
// Where light is shared among the ψ around it (direction_filter.h), what a ψ gets is not that of its cell but that of its
// tent, and so are the integrals.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "dlm/direction_filter.h"
#include "dlm/direction_tents.h"
#include "dlm/direction_triangles.h"
#include "dlm/octahedral_grid.h"
#include "dlm/spherical_polygon.h"

namespace lucarne {

/// The part of a cell, or tent, above a horizon: integrals over {ω in the cell, n·ω > 0}, ω unit, by solid angle; of a
/// tent each ω counts by its weight.
struct ClippedCell {
  double solidAngle = 0;   // ∫ dω, sr
  Vec3d moment{};          // ∫ ω dω; its direction is the mean light direction
  double cosIntegral = 0;  // ∫ n·ω dω = n · moment, sr: the irradiance per unit of constant radiance
  double meanCosine() const { return solidAngle > 0 ? cosIntegral / solidAngle : 0; }
};

/// Which ψ are taken for members where tents are cut by a horizon: those whose cell reaches above it, as on a flat side,
/// or all, as where normals vary.
enum class Members : std::uint8_t { reaching, all };

class DirectionSet {
 public:
  explicit DirectionSet(int count, DirectionFilter filter = DirectionFilter::nearest);  // 1 … 65535

  int count() const { return static_cast<int>(directions_.size()); }
  Vec3d direction(int psi) const { return directions_[static_cast<std::size_t>(psi)]; }
  const std::vector<Vec3d>& directions() const { return directions_; }

  /// The ψ with the largest dot product with `w` (float arithmetic, smallest index on a tie). Exact and O(1) on
  /// average.
  [[gnu::always_inline]] int nearest(Vec3f w) const {
    const int at = octahedralCell(w, gridSize_);
    if (at < 0) return 0;
    const auto cell = static_cast<std::size_t>(at);
    // Nearly all cells have one or two candidates; of two the nearer is told without a branch.
    const auto [first, second] = two_[cell];
    if (first == kSeveral) [[unlikely]]
      return nearestOfSeveral(cell, w);
    return first + (second - first) * static_cast<int>(dot(directionsF_[second], w) > dot(directionsF_[first], w));
  }

  /// The triangles of ψ that light is shared in; null where it goes into the nearest cell: with that filter, and with
  /// fewer than 4 directions.
  const DirectionTriangles* triangles() const { return shared_ ? &shared_->triangles : nullptr; }

  /// Integrals over the cell or tent of ψ above the plane of unit normal `n`; of cells exact, closed forms over spherical
  /// polygons.
  ClippedCell clippedCell(int psi, Vec3d n, Members members = Members::reaching) const;
  /// ∫ ω (n·ω) dω over the same part: divided by cosIntegral, the mean direction of what constant light brings, as
  /// mean_direction.h has it.
  Vec3d cosineMoment(int psi, Vec3d n, Members members = Members::reaching) const;
  /// The whole cell, also where there are tents.
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
  int nearestOfSeveral(std::size_t cell, Vec3f w) const;
  void buildCells();
  void buildLookup();
  SphericalIntegral above(int psi, Vec3d n) const;
  TentIntegral tentAbove(int psi, Vec3d n, Members members) const;

  struct Shared {  // of directions that it holds itself: sets are copied and moved
    explicit Shared(const std::vector<Vec3d>& set) : directions(set), triangles(directions), tents(directions, triangles) {}
    std::vector<Vec3d> directions;
    DirectionTriangles triangles;
    DirectionTents tents;
  };

  std::vector<Vec3d> directions_;
  std::shared_ptr<const Shared> shared_;  // null: nearest
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
