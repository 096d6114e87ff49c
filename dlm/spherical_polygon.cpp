#include "dlm/spherical_polygon.h"

#include "base/error.h"
#include "base/math.h"

namespace lucarne {

namespace {

// Van Oosterom and Strackee 1983, equation 8: tan(Ω/2) = det(a,b,c) / (1 + a·b + b·c + c·a) for unit a, b, c. The
// determinant is taken of differences, a·((b−a)×(c−a)), so that it stays exact for small triangles.
double triangleSolidAngle(Vec3d a, Vec3d b, Vec3d c) {
  const double det = dot(a, cross(b - a, c - a));
  const double denominator = 1 + dot(a, b) + dot(b, c) + dot(c, a);
  return 2 * atan2(det, denominator);
}

}  // namespace

void SphericalPolygon::add(Vec3d unit) {
  LUCARNE_CHECK_LT(count, kMaxVertices);
  vertices[static_cast<std::size_t>(count++)] = unit;
}

double angleBetween(Vec3d a, Vec3d b) { return atan2(length(cross(a, b)), dot(a, b)); }

// Sutherland and Hodgman 1974, on cones: an edge from a to b crosses the plane at d_a·b − d_b·a, d the distances.
SphericalPolygon clip(std::span<const Vec3d> polygon, Vec3d normal) {
  SphericalPolygon result;
  if (polygon.size() < 3) return result;
  Vec3d a = polygon.back();
  double da = dot(a, normal);
  for (const Vec3d& b : polygon) {
    const double db = dot(b, normal);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const Vec3d crossing = b * std::abs(da) + a * std::abs(db);
      result.add(normalize(crossing));
    }
    if (db >= 0) result.add(b);
    a = b;
    da = db;
  }
  return result;
}

double solidAngle(std::span<const Vec3d> polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) sum += triangleSolidAngle(polygon[0], polygon[i - 1], polygon[i]);
  return sum;
}

// The cone over the polygon, {rω : ω in P, r <= 1}, is closed, so its outward area vectors sum to zero. Its curved side
// contributes ∫ ω dω; the flat side over an edge a→b is a sector of area θ/2 with outward normal −n, n = a×b / |a×b|
// (inward for counter-clockwise order). Hence ∫ ω dω = ½ Σ θ n.
Vec3d moment(std::span<const Vec3d> polygon) {
  Vec3d sum{};
  if (polygon.size() < 3) return sum;
  Vec3d a = polygon.back();
  for (const Vec3d& b : polygon) {
    const Vec3d normal = cross(a, b - a);  // = a × b, exact for short edges
    const double sine = length(normal);
    if (sine > 0) sum += normal * (0.5 * atan2(sine, dot(a, b)) / sine);
    a = b;
  }
  return sum;
}

SphericalIntegral integrate(std::span<const Vec3d> polygon) { return {solidAngle(polygon), moment(polygon)}; }

}  // namespace lucarne
