// Convex spherical polygons, smaller than a hemisphere: clipping by planes through the centre and exact integrals.
//
// Plain arithmetic only (base/math.h), so that everything derived from them has the same bits on every machine.
#pragma once

#include <array>
#include <span>

#include "base/vec.h"

namespace lucarne {

/// ∫ dω (sr) and ∫ ω dω over a region of the unit sphere.
struct SphericalIntegral {
  double solidAngle = 0;
  Vec3d moment{};
  SphericalIntegral& operator+=(const SphericalIntegral& b) {
    solidAngle += b.solidAngle;
    moment += b.moment;
    return *this;
  }
};

/// Convex polygon of great-circle arcs, counter-clockwise seen from outside; unit vertices; fewer than three: empty.
struct SphericalPolygon {
  static constexpr int kMaxVertices = 24;
  int count = 0;
  std::array<Vec3d, kMaxVertices> vertices;

  bool empty() const { return count < 3; }
  /// Throws std::logic_error beyond kMaxVertices.
  void add(Vec3d unit);
  std::span<const Vec3d> span() const { return {vertices.data(), static_cast<std::size_t>(count)}; }
};

/// The part of `polygon` where dot(normal, ω) >= 0. `normal` need not be unit.
SphericalPolygon clip(std::span<const Vec3d> polygon, Vec3d normal);

/// Exact integrals over the polygon; zero for fewer than three vertices.
double solidAngle(std::span<const Vec3d> polygon);
Vec3d moment(std::span<const Vec3d> polygon);
SphericalIntegral integrate(std::span<const Vec3d> polygon);
/// ∫ ω (ω·n) dω over the polygon.
Vec3d momentAlong(std::span<const Vec3d> polygon, Vec3d n);

/// The angle between two vectors, 0 … π,, to about 1e-15; the vectors need not be unit.
double angleBetween(Vec3d a, Vec3d b);

}  // namespace lucarne
