// Smooth boundary between two clear media: Fresnel's share and the refracted direction. eta = n_transmitted /
// n_incident.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace lucarne {

/// What the boundary does with a ray at cosine cosI > 0 from its normal.
struct Refraction {
  float fresnel;       // share of unpolarised light that is reflected
  float cosT;          // cosine of the refracted ray from the opposite normal
  bool total = false;  // no refracted ray exists: total internal reflection, fresnel = 1
};

/// Share reflected, unpolarised (Fresnel; Born and Wolf 1999, §1.5.2, equations 32 and 33). For one pair of cosines of
/// Snell's law, so the answer is the same from both sides.
inline float fresnelDielectric(float cosI, float cosT, float eta) {
  const float sum = cosI + eta * cosT;
  const float s = (1.f - eta) * (1.f + eta) / (sum * sum);  // (cosI − eta·cosT)/(cosI + eta·cosT) without cancellation
  const float p = (eta * cosI - cosT) / (eta * cosI + cosT);
  return 0.5f * (s * s + p * p);
}

/// An index that is no positive finite number stands for infinity, which reflects all.
inline bool reflectsAll(float eta) { return !(eta > 0 && eta < 1e30f); }

/// Indices within 1e-4 of each other make no boundary. The same for eta and 1/eta.
inline bool isStraight(float eta) { return std::abs(eta * eta - 1.f) < 2e-4f * eta; }

inline Refraction refraction(float cosI, float eta) {
  if (reflectsAll(eta)) return {1, 0, false};
  const float cos2 = 1.f - (1.f - cosI * cosI) / (eta * eta);
  if (!(cos2 > 0)) return {1, 0, true};
  const float cosT = std::sqrt(cos2);
  return {fresnelDielectric(cosI, cosT, eta), cosT, false};
}

/// The refracted direction, away from the surface as `w` is; cosI = w·h > 0.
inline Vec3f refract(Vec3f w, Vec3f h, float cosI, float cosT, float eta) {
  return normalize(h * (cosI / eta - cosT) - w / eta);
}

}  // namespace lucarne
