// How near a segment comes to a triangle.
#pragma once

#include <array>

#include "base/vec.h"

namespace lucarne {

struct NearestPair {
  Vec3d onSegment, onTriangle;
  double squaredDistance = 1e300;
};

/// The nearest points of the segment p q and the triangle; distance 0 where they cross. Triangles and segments without
/// extent are taken for what is left of them.
NearestPair nearestPair(Vec3d p, Vec3d q, const std::array<Vec3d, 3>& triangle);

}  // namespace lucarne
