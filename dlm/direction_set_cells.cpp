#include "dlm/direction_set_cells.h"

#include <algorithm>
#include <numeric>

namespace lucarne {

namespace {

std::array<SphericalPolygon, 8> octants() {
  std::array<SphericalPolygon, 8> result;
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1) ? -1 : 1, y = (i & 2) ? -1 : 1, z = (i & 4) ? -1 : 1;
    const bool flip = x * y * z < 0;
    SphericalPolygon& octant = result[static_cast<std::size_t>(i)];
    octant.add({x, 0, 0});
    octant.add(flip ? Vec3d{0, 0, z} : Vec3d{0, y, 0});
    octant.add(flip ? Vec3d{0, y, 0} : Vec3d{0, 0, z});
  }
  return result;
}

double smallestCosine(const SphericalPolygon& polygon, Vec3d axis) {
  double smallest = 1;
  for (const Vec3d& v : polygon.span()) smallest = std::min(smallest, dot(v, axis));
  return smallest;
}

// Cosine of half the angle whose cosine is `cosine`.
double halfAngleCosine(double cosine) { return std::sqrt(std::max(0.0, 0.5 * (1 + cosine))); }

}  // namespace

VoronoiSphere::VoronoiSphere(std::span<const Vec3d> sites) : sites_(sites), byHeight_(sites.size()) {
  std::iota(byHeight_.begin(), byHeight_.end(), 0u);
  std::sort(byHeight_.begin(), byHeight_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return sites_[a].z != sites_[b].z ? sites_[a].z < sites_[b].z : a < b;
  });
}

// All other sites within a chord length, the nearest first. Only the band of heights that the chord allows is searched.
std::vector<VoronoiSphere::Neighbour> VoronoiSphere::within(std::size_t site, double chord) const {
  const Vec3d p = sites_[site];
  const double smallest = 1 - 0.5 * chord * chord;  // chord² = 2 − 2 cos
  const auto first = std::lower_bound(byHeight_.begin(), byHeight_.end(), p.z - chord,
                                      [&](std::uint32_t a, double z) { return sites_[a].z < z; });
  std::vector<Neighbour> found;
  for (auto it = first; it != byHeight_.end() && sites_[*it].z <= p.z + chord; ++it) {
    const double cosine = dot(sites_[*it], p);
    if (*it != site && cosine >= smallest) found.push_back({cosine, *it});
  }
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.cosine != b.cosine ? a.cosine > b.cosine : a.site < b.site;
  });
  return found;
}

// A site at angle d cuts nothing that lies within d/2 of ψ: the bisector plane is d/2 away. So clipping goes outward
// and ends when the next site is at more than twice the polygon's radius; if the neighbours found run out before, more
// are fetched. (The radius of a convex polygon about ψ, when below 90 degrees, is reached at a vertex.)
std::vector<SphericalPolygon> VoronoiSphere::cell(std::size_t site) const {
  static const std::array<SphericalPolygon, 8> kOctants = octants();
  const Vec3d p = sites_[site];
  double chord =
      std::min(2.5, 13 / std::sqrt(static_cast<double>(sites_.size())));  // about twice the neighbours' distance
  while (true) {
    const bool all = chord > 2;
    const std::vector<Neighbour> neighbours = within(site, chord);
    const double cosineBeyond = 1 - 0.5 * chord * chord;
    std::vector<SphericalPolygon> pieces;
    bool certain = true;
    for (const SphericalPolygon& octant : kOctants) {
      SphericalPolygon piece = octant;
      double radius = smallestCosine(piece, p);
      for (const Neighbour& other : neighbours) {
        if (piece.empty() || radius > halfAngleCosine(other.cosine)) break;
        piece = clip(piece.span(), p - sites_[other.site]);
        radius = smallestCosine(piece, p);
      }
      certain = certain && (all || piece.empty() || radius > halfAngleCosine(cosineBeyond));
      if (!piece.empty()) pieces.push_back(piece);
    }
    if (certain) return pieces;
    chord *= 2;
  }
}

}  // namespace lucarne
