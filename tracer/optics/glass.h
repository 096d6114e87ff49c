// Rough dielectric boundary (KHR_materials_transmission, _volume, _ior), in the local frame of a hit.
//
// The normal +z lies on the side of `wi`, so wi.z > 0; wo.z > 0 is reflection, wo.z < 0 transmission. Both directions
// point away from the surface. `wi` looks back to where the light (for camera paths: the camera) came from, `wo` is the
// sampled way on. f has no cosine in it; densities are per steradian of wo.
//
//   f_r = ρ F·D·G2 / (4 cos cos)                       ρ: `reflectance`, but 1 in total internal reflection
//   f_t = tint (1−F)·D·G2 · η² |wi·h||wo·h| / (cos cos (wi·h + η wo·h)²)        (flux; Walter et al. 2007, equation 21)
//
// with GGX facets h, exact F of unpolarised light, G2 = 1/(1 + Λi + Λo) in reflection (height-correlated) and
// 1/((1 + Λi)(1 + Λo)) in transmission (Walter's equation 23: it is symmetric, and G2/G1 ≤ 1 holds, so the albedo is
// ≤ 1 for tint and reflectance ≤ 1). What is shadowed by other facets is lost. A thin wall transmits into the mirror
// image of the reflected direction: f_t = tint (1−F)·D·G2 / (4 cos cos), with the G2 of reflection.
//
// Reciprocity. Let light travel from wi (index n1) to wo (index n2), η = n2/n1. The BSDF of radiance obeys
// f_s(wi→wo)/n2² = f_s(wo→wi)/n1² (Veach 1997, §5.2). A photon carries flux along the light: its weight is
// f_s(wi→wo)·|cos wo|/pdf(wo), and its integral over wo is ≤ 1. That is f_flux above. A camera ray comes from wo and
// samples wi; it must weigh with the same f_s(wi→wo). Seen from its side, with η' = 1/η and the arguments in its order,
// that value is called f_radiance':
//
//   f_radiance'(wo, wi) = f_s(wi→wo) = f_flux(wi, wo) = η² f_flux'(wo, wi),   so   f_radiance' = f_flux' / η'²
//
// in refraction (radiance shrinks by 1/η'² against flux), and f_radiance = f_flux in reflection and through thin walls.
// `other` side: the same tint and reflectance, eta → 1/eta (a thin wall keeps its eta), z of both directions flipped.
#pragma once

#include <optional>

#include "tracer/optics/bsdf.h"
#include "tracer/optics/glass_table.h"

namespace lucarne {

struct Glass {
  Rgb tint{1.f};         // multiplies what is transmitted
  Rgb reflectance{1.f};  // in [0, 1]: multiplies Fresnel reflection, but not total internal reflection
  /// n_transmitted / n_incident as seen from wi: ior from outside, 1/ior from inside; the ior for thin walls, from
  /// either side. 0 or infinity reflects all. Within 1e-4 of 1 a volume has no boundary: light goes straight on.
  float eta = 1.5f;
  float alpha = 1e-3f;  // GGX α ≥ kMinAlpha
  bool thin = false;    // a wall without volume
};

/// What a path carries: photons flux, camera paths radiance.
enum class Transport { flux, radiance };

/// f(wi, wo), per steradian.
Rgb evaluate(const Glass& glass, Vec3f wi, Vec3f wo, Transport transport);
/// Density of sample() per steradian of wo; its integral is less than 1 where sample() may be empty.
float pdf(const Glass& glass, Vec3f wi, Vec3f wo);
/// A facet h of those visible, then reflection with probability F'/(F' + T'), F' = mean(reflectance)·F and
/// T' = mean(tint)·(1−F), else transmission. Empty where a reflected direction falls below the surface or a transmitted
/// one above it (its share is lost), or wi.z ≤ 0. u = (lobe, direction u, direction v).
std::optional<BsdfSample> sample(const Glass& glass, Vec3f wi, Vec3f u, Transport transport);
/// Expectation of the weight for Transport::flux (0 where sample() is empty). `table` is that of the glass; `inside`:
/// wi lies within the volume.
Rgb albedo(const Glass& glass, const GlassTable& table, Vec3f wi, bool inside);

}  // namespace lucarne
