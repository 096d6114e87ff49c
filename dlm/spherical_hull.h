// The Delaunay triangles of points on the sphere: the faces of their convex hull.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace lucarne {

struct HullTriangle {
  std::array<std::uint32_t, 3> v;       // points, counter-clockwise seen from outside
  std::array<std::uint32_t, 3> across;  // the triangle beyond the edge opposite v[k]
};

/// The 2n − 4 triangles of n ≥ 4 unit vectors, distinct and not all on one circle. Points on one circle that no other
/// lies in are cut into triangles in one of the possible ways. Plain arithmetic only: the same triangles on every
/// machine. std::logic_error where the hull is none (points within rounding of each other).
std::vector<HullTriangle> sphericalHull(std::span<const Vec3d> points);

}  // namespace lucarne
