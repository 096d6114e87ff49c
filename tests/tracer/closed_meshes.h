// Closed things, seen from inside, for tests of watertightness.
#pragma once

#include <array>
#include <map>

#include "tests/support/scene_builder.h"

namespace lucarne::test {

/// A cube blown up to a ball of uneven facets, fronts inward: 12·cells² triangles. Neighbours share their corners to
/// the last bit; edges are of very different lengths. Corners are `radius` or up to a share of `depth` less from the
/// center, which all of it can be seen from: with a depth of nearly 1 the ball is all spikes.
class BumpyBall {
 public:
  BumpyBall(Vec3d center, double radius, int cells, double depth = 0.2)
      : center_(center), radius_(radius), depth_(depth), cells_(cells) {}

  void addTo(SceneBuilder& b, std::uint32_t material) {
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-cells_, cells_})
        for (int i = -cells_; i < cells_; i += 2)
          for (int j = -cells_; j < cells_; j += 2) addCell(b, material, axis, side, i, j);
  }

 private:
  using Lattice = std::array<int, 3>;

  void addCell(SceneBuilder& b, std::uint32_t material, int axis, int side, int i, int j) {
    const auto corner = [&](int u, int v) {
      Lattice l{};
      const auto at = [&](int k) -> int& { return l[static_cast<std::size_t>((axis + k) % 3)]; };
      at(0) = side;
      at(1) = u;
      at(2) = v;
      return point(l);
    };
    const Vec3d p0 = corner(i, j), p1 = corner(i + 2, j), p2 = corner(i + 2, j + 2), p3 = corner(i, j + 2);
    if (side > 0) {
      b.addTriangle(p0, p2, p1, material);
      b.addTriangle(p0, p3, p2, material);
    } else {
      b.addTriangle(p0, p1, p2, material);
      b.addTriangle(p0, p2, p3, material);
    }
  }

  Vec3d point(const Lattice& l) {
    const auto [at, isNew] = points_.try_emplace(l);
    if (!isNew) return at->second;
    // Numbers in [0, 1) from the place on the lattice.
    const auto hash = [&](std::uint64_t salt) {
      std::uint64_t h = salt;
      for (const int x : l) h = (h ^ static_cast<std::uint64_t>(x + 1000)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
      return static_cast<double>(h >> 11) * 0x1p-53;
    };
    Vec3d p;
    for (int k = 0; k < 3; ++k)
      p[k] = l[static_cast<std::size_t>(k)] + 0.8 * (hash(static_cast<std::uint64_t>(k) + 1) - 0.5);
    return at->second = center_ + normalize(p) * (radius_ * (1 - depth_ + depth_ * hash(9)));
  }

  Vec3d center_;
  double radius_, depth_;
  int cells_;
  std::map<Lattice, Vec3d> points_;
};

}  // namespace lucarne::test
