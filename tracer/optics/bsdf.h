// The glTF metallic-roughness surface: a Lambert base under a GGX coat, in the local frame (normal +z).
//
// Both directions point away from the surface. For photons `wi` looks back to where the light came from and `wo` is
// the sampled way on; the BSDF is reciprocal, so camera paths may use it either way round. f has no cosine in it.
//
//   f = f_s + f_m + (c/π) · (1 − r(wi)) · (1 − r(wo)) / (1 − r̄)
//   f_s = F·D·G2/(4 cos cos),  F = F0 + (F90 − F0)(1 − wi·h)⁵,  f_m: light that meets several facets (coat.h)
//
// r = largest component of the coat's directional albedo ρ, r̄ its mean over the hemisphere: what the coat reflects does
// not reach the base (Kelemen and Szirmay-Kalos 2001), which keeps reciprocity and makes the albedo exactly a(wi) =
// ρ(wi) + c·(1 − r(wi)) ≤ 1. With F0 = F90 = 0 it is exactly Lambert.
#pragma once

#include <optional>

#include "base/vec.h"
#include "tracer/optics/warp.h"

namespace lucarne {

struct Bsdf {
  Rgb diffuse{};    // c: albedo of the base
  Rgb f0{}, f90{};  // of the coat
  float alpha = 1;  // GGX α

  bool lambert() const { return maxComponent(f0) <= 0 && maxComponent(f90) <= 0; }
};

struct BsdfSample {
  Vec3f wo;
  Rgb weight;  // f·|cos wo|/pdf, nothing else
  float pdf;   // per steradian, both lobes
};

/// f(wi, wo), per steradian. Zero unless both are above the surface.
Rgb evaluate(const Bsdf& bsdf, Vec3f wi, Vec3f wo);
/// Density of sample() per steradian of wo.
float pdf(const Bsdf& bsdf, Vec3f wi, Vec3f wo);
/// Empty when the sampled direction falls below the surface (its share of the energy is absorbed) or wi.z ≤ 0.
/// u = (lobe, direction u, direction v).
std::optional<BsdfSample> sample(const Bsdf& bsdf, Vec3f wi, Vec3f u);
/// Way on from a Lambert surface; the weight is `diffuse`: f·cos/pdf = (c/π)·cos/(cos/π) = c.
inline Vec3f sampleLambert(Vec2f u) { return sampleCosineHemisphere(u); }
/// a(wi): fraction of the light from wi that goes on, the expectation of the weight (0 where sample() is empty).
Rgb albedo(const Bsdf& bsdf, Vec3f wi);

/// sample() and albedo() of one hit: they share the lookups of the coat.
struct SampleWithAlbedo {
  std::optional<BsdfSample> sample;
  Rgb albedo{};
};
SampleWithAlbedo sampleWithAlbedo(const Bsdf& bsdf, Vec3f wi, Vec3f u);

}  // namespace lucarne
