// Shading normals: what they receive, and Veach's correction for them.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace lucarne {

/// Corrections by shading normals are clamped to this; how often is counted, how much is booked.
inline constexpr float kLargestShadingCorrection = 4;
/// Shading normals keep at least this cosine to the geometric one.
inline constexpr float kLeastShadingCosine = 0.01f;

/// `ns` itself, or bent toward `n` so far that it keeps the least cosine. It depends on the place alone, not on where
/// light comes from, or light going one way would meet another surface than light going back. Both unit.
inline Vec3f keepInFront(Vec3f ns, Vec3f n) {
  const float c = dot(ns, n);
  return c >= kLeastShadingCosine ? ns : normalize(ns + n * (kLeastShadingCosine - c));
}

/// max(0, ns·wi) / |n·wi|: what the shaded surface receives of light that falls on the flat one. Not clamped. For wi on
/// the side of n.
inline float shadingReception(Vec3f wi, Vec3f n, Vec3f ns) {
  return std::max(0.f, dot(ns, wi)) / std::max(std::abs(dot(n, wi)), 1e-6f);
}

/// Factor of a photon's weight at a surface with a shading normal. It makes the BSDF non-symmetric; light carries the
/// adjoint one, f · |wi·ns||wo·n| / (|wi·n||wo·ns|) (Veach 1997, equation 5.19), and none where wo is on different
/// sides of the two (light would leak through the surface) or wi is behind the shading normal. Not clamped. wi is on
/// the side of n.
inline float adjointCorrection(Vec3f wi, Vec3f wo, Vec3f n, Vec3f ns) {
  const float woN = dot(wo, n), woNs = dot(wo, ns);
  if (!(woN * woNs > 0)) return 0;
  return shadingReception(wi, n, ns) * (woN / woNs);
}

}  // namespace lucarne
