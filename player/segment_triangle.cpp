#include "player/segment_triangle.h"

#include <algorithm>

namespace lucarne {
namespace {

double share(double part, double whole) { return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0; }

void consider(NearestPair& best, Vec3d onSegment, Vec3d onTriangle) {
  const Vec3d d = onSegment - onTriangle;
  if (dot(d, d) < best.squaredDistance) best = {onSegment, onTriangle, dot(d, d)};
}

/// Ericson 2005, "Real-Time Collision Detection", 5.1.9.
void considerEdge(NearestPair& best, Vec3d p, Vec3d q, Vec3d a, Vec3d b) {
  const Vec3d d1 = q - p, d2 = b - a, r = p - a;
  const double along1 = dot(d1, d1), along2 = dot(d2, d2), mixed = dot(d1, d2), c = dot(d1, r), f = dot(d2, r);
  const double denominator = along1 * along2 - mixed * mixed;
  double s = denominator > 1e-12 * along1 * along2 ? std::clamp((mixed * f - c * along2) / denominator, 0.0, 1.0) : 0;
  double t = along2 > 0 ? (mixed * s + f) / along2 : 0;
  if (!(along2 > 0) || t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = share(mixed * t - c, along1);
  }
  consider(best, p + d1 * s, a + d2 * t);
}

/// The foot of a point on the triangle's plane where that is inside; its edges are looked at by considerEdge().
void considerFoot(NearestPair& best, Vec3d point, const std::array<Vec3d, 3>& t, Vec3d n, double squaredNormal) {
  const Vec3d foot = point - n * (dot(point - t[0], n) / squaredNormal);
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(t[(i + 1) % 3] - t[i], foot - t[i]), n) < 0) return;
  }
  consider(best, point, foot);
}

}  // namespace

NearestPair nearestPair(Vec3d p, Vec3d q, const std::array<Vec3d, 3>& triangle) {
  NearestPair best;
  for (std::size_t i = 0; i < 3; ++i) considerEdge(best, p, q, triangle[i], triangle[(i + 1) % 3]);
  const Vec3d n = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double squaredNormal = dot(n, n);
  if (!(squaredNormal > 0)) return best;
  considerFoot(best, p, triangle, n, squaredNormal);
  considerFoot(best, q, triangle, n, squaredNormal);
  const double above = dot(p - triangle[0], n), below = dot(q - triangle[0], n);
  if ((above > 0) != (below > 0)) {  // where the segment goes through the plane, its own foot
    const Vec3d through = p + (q - p) * (above / (above - below));
    considerFoot(best, through, triangle, n, squaredNormal);
  }
  return best;
}

}  // namespace lucarne
