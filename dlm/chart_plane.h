// The plane of a chart: an upright rectangle around its projected triangles.
#pragma once

#include <vector>

#include "base/vec.h"

namespace lucarne {

struct ChartPlane {
  Vec3d normal{}, axisU{}, axisV{};  // orthonormal, axisU × axisV = normal
  Vec2d origin{}, size{};            // of the rectangle, in (dot(p, axisU), dot(p, axisV))

  Vec2d project(Vec3d p) const { return Vec2d{dot(p, axisU), dot(p, axisV)} - origin; }
};

/// Unit vector along `v`, exactly an axis where it is one but for rounding.
Vec3d snappedNormal(Vec3d v);

/// Axes of a plane: exact for axis-aligned normals, else axisU is level (perpendicular to y).
void planeAxes(Vec3d normal, Vec3d& axisU, Vec3d& axisV);

/// `x` as a float within [0, size].
float clampedInside(double x, double size);

/// Convex hull, counter-clockwise, without collinear points; of a set on a line its two ends.
std::vector<Vec2d> convexHull(std::vector<Vec2d> points);

/// Rectangle of least area around the projected points, the longer side along axisU. planeAxes() win ties.
/// A size is at least `minSize`.
ChartPlane fitPlane(Vec3d normal, const std::vector<Vec3d>& points, double minSize);

}  // namespace lucarne
