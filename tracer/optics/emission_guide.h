// A guide for light from far away: most photons from a sky or a sun that is seen through windows miss all of them.
//
// Where such a photon starts is decided by four numbers in [0, 1): two for its direction, two for its place on the disc
// that covers the scene. The guide is a density over that cube, constant in each cell of a grid, by which the numbers
// are warped (primary sample space, as in Müller, Gross, Novák 2017, "Practical path guiding", but for emission). A
// quarter of it is uniform, so that no photon weighs more than four times what it would without. The cells' weights are
// integers: the density is exact, and the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/hash.h"
#include "base/vec.h"

namespace lucarne {

/// Cells along each of the two axes of direction and of place. A light of one direction has 1.
struct GuideGrid {
  std::uint32_t direction = 1, place = 1;
  std::size_t cells() const { return std::size_t{direction} * direction * place * place; }
  friend bool operator==(const GuideGrid&, const GuideGrid&) = default;
};

class EmissionGuide {
 public:
  /// `usefulness` ≥ 0 by cell, any scale: [direction.x][direction.y][place.x][place.y]. All zero gives a uniform guide.
  EmissionGuide(GuideGrid grid, std::span<const double> usefulness);

  struct Numbers {
    Vec2f direction, place;
    double density;  // of the warped numbers over the unit cube: a photon's weight is divided by it
  };
  /// Inversion axis by axis: neighbours stay neighbours.
  Numbers warp(Vec2f direction, Vec2f place) const;
  /// Density in a cell.
  double densityOf(std::size_t cell) const;

  std::size_t cellOf(Vec2f direction, Vec2f place) const;
  const GuideGrid& grid() const { return grid_; }
  Hash128 hash() const;

 private:
  GuideGrid grid_;
  std::uint64_t total_ = 0;
  std::vector<std::uint32_t> weights_;              // by cell, ≥ kUniform
  std::array<std::vector<std::uint64_t>, 4> sums_;  // [axis]: weight of all cells below each prefix of indices
};

}  // namespace lucarne
