// The points of a direction set and their Voronoi cells on the unit sphere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "dlm/spherical_polygon.h"

namespace lucarne {

/// Finds Voronoi cells one by one; keeps a view of `sites`, unit and distinct.
class VoronoiSphere {
 public:
  explicit VoronoiSphere(std::span<const Vec3d> sites);

  /// The cell of a site, clipped to the eight octants so that every piece is smaller than a hemisphere (one piece at
  /// least; for one site, the whole sphere).
  std::vector<SphericalPolygon> cell(std::size_t site) const;

 private:
  struct Neighbour {
    double cosine;
    std::uint32_t site;
  };
  std::vector<Neighbour> within(std::size_t site, double chord) const;

  std::span<const Vec3d> sites_;
  std::vector<std::uint32_t> byHeight_;  // sites in ascending z
};

/// The n near-uniform points of a direction set; see direction_set.h for the construction.
std::vector<Vec3d> spreadDirections(int count);

}  // namespace lucarne
