#include "tracer/optics/scattering.h"

#include "tracer/optics/coat.h"

namespace lucarne {

Scattering scatteringAt(const SurfaceTable& surfaces, const SurfacePlace& at, bool back) {
  Scattering s;
  s.opaque = surfaces.bsdf(at, s.opaque);
  s.coat = surfaces.coat(at.material);
  if (!surfaces.transmits(at.material)) return s;
  const GlassPart glass = surfaces.glass(at, back);
  s.share = glass.share;
  s.glass = glass.glass;
  s.table = glass.table;
  s.inside = back;
  return s;
}

std::optional<BsdfSample> sample(const Scattering& s, Vec3f wi, Vec3f u, Transport transport) {
  if (s.table == nullptr) return sample(s.opaque, wi, u);
  const bool glass = u.x < s.share;
  // What is left of the number picks the lobe. A share of 0 or 1 leaves it whole.
  u.x = std::min(glass ? u.x / s.share : (u.x - s.share) / (1 - s.share), 1 - 0x1p-24f);
  std::optional<BsdfSample> result = glass ? sample(s.glass, wi, u, transport) : sample(s.opaque, wi, u);
  if (result) {
    const float other = glass ? pdf(s.opaque, wi, result->wo) : pdf(s.glass, wi, result->wo);
    const float share = glass ? s.share : 1 - s.share;
    result->pdf = share * result->pdf + (1 - share) * other;
  }
  return result;
}

Rgb evaluate(const Scattering& s, Vec3f wi, Vec3f wo, Transport transport) {
  if (s.table == nullptr) return evaluate(s.opaque, wi, wo);
  return evaluate(s.opaque, wi, wo) * (1 - s.share) + evaluate(s.glass, wi, wo, transport) * s.share;
}

float pdf(const Scattering& s, Vec3f wi, Vec3f wo) {
  if (s.table == nullptr) return pdf(s.opaque, wi, wo);
  return pdf(s.opaque, wi, wo) * (1 - s.share) + pdf(s.glass, wi, wo) * s.share;
}

Rgb albedo(const Scattering& s, Vec3f wi) {
  if (s.table == nullptr) return albedo(s.opaque, wi);
  return albedo(s.opaque, wi) * (1 - s.share) + albedo(s.glass, *s.table, wi, s.inside) * s.share;
}

}  // namespace lucarne
