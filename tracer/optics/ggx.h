// GGX microfacets with height-correlated Smith shadowing, in the local frame (normal +z). `alpha` = glTF roughness squared.
#pragma once

#include <cmath>

#include "base/math.h"
#include "base/vec.h"
#include "tracer/optics/warp.h"

namespace lucarne {

inline constexpr float kMinAlpha = 1e-3f;  // below it the lobe is narrower than single precision resolves well

/// Schlick's (1 − c)^5.
inline float schlick(float c) {
  const float m = std::clamp(1.f - c, 0.f, 1.f);
  const float m2 = m * m;
  return m2 * m2 * m;
}

/// Normal distribution D(h), per steradian (Trowbridge and Reitz 1975; Walter et al. 2007, equation 33).
inline float ggxD(float cosH, float alpha) {
  const float a2 = alpha * alpha;
  const float d = (1.f - cosH * cosH) + a2 * cosH * cosH;  // written without cancellation at cosH ≈ 1, small alpha
  return a2 / (kPi * d * d);
}

/// The same of a unit vector: its sine comes from x and y, so that it is exact at the smallest alpha too.
inline float ggxD(Vec3f h, float alpha) {
  const float a2 = alpha * alpha;
  const float d = (h.x * h.x + h.y * h.y) + a2 * h.z * h.z;
  return a2 / (kPi * d * d);
}

/// Smith's Λ for a direction at cosine c > 0.
inline float ggxLambda(float c, float alpha) {
  const float c2 = c * c;
  return 0.5f * (std::sqrt(1.f + alpha * alpha * (1.f - c2) / c2) - 1.f);
}
inline float ggxG1(float c, float alpha) { return 1.f / (1.f + ggxLambda(c, alpha)); }
inline float ggxG2(float ci, float co, float alpha) { return 1.f / (1.f + ggxLambda(ci, alpha) + ggxLambda(co, alpha)); }

/// Half vector seen from `w` (w.z > 0). pdf(h) = G1(w)·max(0, w·h)·D(h)/w.z per steradian; the reflected direction has
/// pdf(h) / (4 w·h). (Heitz 2018, "Sampling the GGX distribution of visible normals", listing 1.)
inline Vec3f sampleVisibleNormal(Vec3f w, float alpha, Vec2f u) {
  const Vec3f v = normalize(Vec3f{alpha * w.x, alpha * w.y, w.z});
  const float lensq = v.x * v.x + v.y * v.y;
  const Vec3f t1 = lensq > 0 ? Vec3f{-v.y, v.x, 0} / std::sqrt(lensq) : Vec3f{1, 0, 0};
  const Vec3f t2 = cross(v, t1);
  const Vec2f d = sampleDisc(u);
  const float s = 0.5f * (1.f + v.z);
  const float p2 = (1.f - s) * std::sqrt(std::max(0.f, 1.f - d.x * d.x)) + s * d.y;
  const Vec3f h = t1 * d.x + t2 * p2 + v * std::sqrt(std::max(0.f, 1.f - d.x * d.x - p2 * p2));
  return normalize(Vec3f{alpha * h.x, alpha * h.y, std::max(1e-6f, h.z)});
}
inline float pdfVisibleReflection(Vec3f w, Vec3f h, float alpha) {
  return ggxG1(w.z, alpha) * ggxD(h.z, alpha) / (4.f * w.z);
}

inline Vec3f reflect(Vec3f w, Vec3f h) { return h * (2.f * dot(w, h)) - w; }

}  // namespace lucarne
