// The point of a triangle nearest to a given one.
#pragma once

#include "base/vec.h"

namespace lucarne {

struct ClosestPoint {
  double distance;
  double b1, b2;  // barycentrics of b and c
};

ClosestPoint closestPoint(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

}  // namespace lucarne
