// Warps of the unit square, each with its density (measure in the name of the comment). u in [0, 1)². No libm but sqrt.
#pragma once

#include <cmath>

#include "base/math.h"
#include "base/vec.h"

namespace lucarne {

inline constexpr float kPi = 3.14159265358979323846f;

/// Uniform disc of radius 1, z = 0. pdf = 1/π per unit area.
inline Vec2f sampleDisc(Vec2f u) {
  float s, c;
  sinCosTurns(u.y, s, c);
  const float r = std::sqrt(u.x);
  return {r * c, r * s};
}

/// Cosine-weighted hemisphere around +z. pdf = z/π per steradian.
inline Vec3f sampleCosineHemisphere(Vec2f u) {
  const Vec2f d = sampleDisc(u);
  return {d.x, d.y, std::sqrt(std::max(0.f, 1.f - u.x))};
}
inline float pdfCosineHemisphere(Vec3f w) { return w.z > 0 ? w.z / kPi : 0.f; }

/// Uniform sphere. pdf = 1/(4π) per steradian.
inline Vec3f sampleSphere(Vec2f u) {
  float s, c;
  sinCosTurns(u.y, s, c);
  const float z = 1.f - 2.f * u.x;
  const float r = std::sqrt(std::max(0.f, 1.f - z * z));
  return {r * c, r * s, z};
}

/// Direction at the given cosine from +z, uniform azimuth.
inline Vec3f directionAround(float cosTheta, float uAzimuth) {
  float s, c;
  sinCosTurns(uAzimuth, s, c);
  const float r = std::sqrt(std::max(0.f, 1.f - cosTheta * cosTheta));
  return {r * c, r * s, cosTheta};
}

/// Uniform barycentrics (b1, b2) of a triangle, b0 = 1 − b1 − b2. pdf = 1/area. (Heitz 2019, "A low-distortion map
/// between triangle and square": the fold keeps neighbours near and needs no root.)
inline Vec2f sampleTriangle(Vec2f u) {
  const float half = std::min(u.x, u.y) * 0.5f;
  return {u.x - half, u.y - half};
}

}  // namespace lucarne
