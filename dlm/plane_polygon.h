// Small convex polygons in a plane, and cutting them (Sutherland and Hodgman 1974).
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "base/vec.h"

namespace lucarne {

inline double cross2(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }

/// Twice the area of (a, b, c): positive if they turn left.
inline double orient(Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Convex, either winding. Corners beyond the most are dropped: a triangle cut eleven times fits.
struct PlanePolygon {
  std::array<Vec2d, 14> corner;
  std::size_t count = 0;
  void add(Vec2d p) {
    if (count < corner.size()) corner[count++] = p;
  }
  double signedArea() const {
    double twice = 0;
    for (std::size_t i = 2; i < count; ++i) twice += cross2(corner[i - 1] - corner[0], corner[i] - corner[0]);
    return 0.5 * twice;
  }
  /// Of a counter-clockwise polygon: inside or on its border.
  bool holds(Vec2d p) const {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2d a = corner[i], b = corner[(i + 1) % count];
      if (cross2(b - a, p - a) < 0) return false;
    }
    return count > 2;
  }
};

/// The part where `height`, an affine function of the place, is not negative.
template <class Height>
PlanePolygon clipped(const PlanePolygon& in, Height&& height) {
  PlanePolygon out;
  for (std::size_t i = 0; i < in.count; ++i) {
    const Vec2d a = in.corner[i], b = in.corner[(i + 1) % in.count];
    const double ha = height(a), hb = height(b);
    if (ha >= 0) out.add(a);
    if ((ha >= 0) != (hb >= 0)) out.add(a + (b - a) * (ha / (ha - hb)));
  }
  return out;
}

inline PlanePolygon counterClockwise(PlanePolygon p) {
  if (p.signedArea() < 0)
    for (std::size_t i = 0; i < p.count / 2; ++i) std::swap(p.corner[i], p.corner[p.count - 1 - i]);
  return p;
}

}  // namespace lucarne
