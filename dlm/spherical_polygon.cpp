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

// The divergence theorem for x_j e_i in the same cone: δij Ω/3 = ∫ ωi ωj dω − Σ ni ∫ xj dA over the flat sides, n the
// inward normals as above. Over a sector ∫ x dA = ⅓ ∫ u ds along its edge, and along an arc from a to b of angle θ
// ∫ u ds = (a + b) sin θ/(1 + cos θ). With sin θ n = a × b:
//   ∫ ω (ω·n₀) dω = ⅓ (Ω n₀ + Σ (a × b) (a + b)·n₀ / (1 + a·b))
Vec3d momentAlong(std::span<const Vec3d> polygon, Vec3d n) {
  if (polygon.size() < 3) return {};
  Vec3d sum = n * solidAngle(polygon);
  Vec3d a = polygon.back();
  for (const Vec3d& b : polygon) {
    sum += cross(a, b - a) * (dot(a + b, n) / (1 + dot(a, b)));
    a = b;
  }
  return sum / 3;
}

SphericalIntegral integrate(std::span<const Vec3d> polygon) { return {solidAngle(polygon), moment(polygon)}; }

}  // namespace lucarne
