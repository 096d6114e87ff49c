#include "dlm/probe_closest.h"

namespace lucarne {

namespace {

struct Barycentrics {
  double b1, b2;
};

// Ericson 2005, Real-Time Collision Detection, 5.1.5: the Voronoi regions of the corners, then of the edges, then the
// inside.
Barycentrics closestBarycentrics(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a;
  const double d1 = dot(ab, p - a), d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const double d3 = dot(ab, p - b), d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const double d5 = dot(ab, p - c), d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - w, w};
  }
  return {vb / (va + vb + vc), vc / (va + vb + vc)};
}

}  // namespace

ClosestPoint closestPoint(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Barycentrics at = closestBarycentrics(p, a, b, c);
  return {length(a + (b - a) * at.b1 + (c - a) * at.b2 - p), at.b1, at.b2};
}

}  // namespace lucarne
