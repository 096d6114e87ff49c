// The whole BSDF at a place: the opaque part of the material and its glass, in the frame of the shading normal on the
// side of `wi` (+z).
//
//   f = (1 − t)·f_opaque + t·f_glass      t: share of glass, see makeBsdf()
//
// Directions point away from the surface; wo.z < 0 is transmitted. f has no cosine in it, densities are per steradian
// of wo.
#pragma once

#include <optional>

#include "tracer/optics/bsdf.h"
#include "tracer/optics/glass.h"
#include "tracer/optics/surface.h"

namespace lucarne {

struct Scattering {
  Bsdf opaque;
  const Coat* coat = nullptr;  // of `opaque`, where it is known beforehand
  float share = 0;             // of glass
  Glass glass;
  const GlassTable* table = nullptr;  // null: no glass
  bool inside = false;                // wi is in the volume that the surface bounds
};

/// At a hit on the front or back of a triangle.
Scattering scatteringAt(const SurfaceTable& surfaces, const SurfacePlace& at, bool back);

/// One part is picked by its share and sampled; the weight is that part's f·|cos wo|/pdf, its mean over samples is
/// albedo(). `pdf` is the density of both. u = (part and lobe, direction u, direction v).
std::optional<BsdfSample> sample(const Scattering& s, Vec3f wi, Vec3f u, Transport transport);
Rgb evaluate(const Scattering& s, Vec3f wi, Vec3f wo, Transport transport);
float pdf(const Scattering& s, Vec3f wi, Vec3f wo);
/// Of flux.
Rgb albedo(const Scattering& s, Vec3f wi);

}  // namespace lucarne
