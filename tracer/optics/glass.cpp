#include "tracer/optics/glass.h"

#include "tracer/optics/dielectric.h"
#include "tracer/optics/ggx.h"

namespace lucarne {
namespace {

constexpr float kHorizon = 1e-6f;  // directions closer to the surface than this cosine are not sampled

/// Λ of a direction on either side.
float lambda(Vec3f w, float alpha) { return ggxLambda(std::max(std::abs(w.z), kHorizon), alpha); }

/// A boundary that bends nothing is the limit of a thin wall that reflects nothing: the lobe of refraction has width
/// α·|η − 1|, so the narrowest stands for it. (Its half vector wi + η·wo vanishes.)
Glass limit(Glass g) {
  if (!g.thin && isStraight(g.eta)) {
    g.thin = true;
    g.eta = 1;
    g.alpha = kMinAlpha;
  }
  return g;
}

/// One facet: what it does with light at cosine cosI, and how often sample() reflects there.
struct Facet {
  Refraction r;
  float reflected, transmitted;  // F' and T'
  Facet(const Glass& g, Refraction r_)
      : r(r_),
        reflected((r.total ? 1.f : mean(g.reflectance)) * r.fresnel),
        transmitted(mean(g.tint) * (1.f - r.fresnel)) {}
  float sum() const { return reflected + transmitted; }
  Rgb reflection(const Glass& g) const { return (r.total ? Rgb{1.f} : g.reflectance) * r.fresnel; }
  Rgb transmission(const Glass& g) const { return g.tint * (1.f - r.fresnel); }
};

struct Lobe {
  Rgb f{};  // flux
  float pdf = 0;
};

/// dh/dwo of refraction, with |wi·h + η wo·h| = |1 − η²| / (cosI + η cosT) by Snell's law, free of cancellation.
float refractionJacobian(float cosI, float cosT, float eta) {
  const float x = eta * (cosI + eta * cosT) / ((1.f - eta) * (1.f + eta));
  return cosT * x * x;
}

/// Reflection, and transmission through thin walls, about the half vector of wi and the mirror image `up` of wo.
Lobe mirrorLobe(const Glass& g, Vec3f wi, Vec3f up, bool transmits) {
  const Vec3f h = normalize(wi + up);
  const float cosI = dot(wi, h);
  if (!(cosI > 0)) return {};
  const Facet facet(g, refraction(cosI, g.eta));
  if (!(facet.sum() > 0)) return {};
  const float in = lambda(wi, g.alpha), out = lambda(up, g.alpha);
  const float d = ggxD(h, g.alpha) / (4.f * std::max(wi.z, kHorizon));
  const Rgb share = transmits ? facet.transmission(g) : facet.reflection(g);
  const float chosen = (transmits ? facet.transmitted : facet.reflected) / facet.sum();
  return {share * (d / (std::max(up.z, kHorizon) * (1.f + in + out))), chosen * d / (1.f + in)};
}

Lobe refractionLobe(const Glass& g, Vec3f wi, Vec3f wo) {
  if (reflectsAll(g.eta)) return {};
  Vec3f h = normalize(wi + wo * g.eta);
  if (h.z < 0) h = -h;
  const float cosI = dot(wi, h), cosT = -dot(wo, h);
  if (!(cosI > 0 && cosT > 0)) return {};
  const Facet facet(g, {fresnelDielectric(cosI, cosT, g.eta), cosT, false});
  if (!(facet.sum() > 0)) return {};
  const float in = lambda(wi, g.alpha), out = lambda(wo, g.alpha);
  const float d = ggxD(h, g.alpha) * cosI * refractionJacobian(cosI, cosT, g.eta) /
                  (std::max(wi.z, kHorizon) * (1.f + in));  // density of wo among visible facets
  const Rgb f = facet.transmission(g) * (d / (std::max(-wo.z, kHorizon) * (1.f + out)));
  return {f, facet.transmitted / facet.sum() * d};
}

Lobe lobe(const Glass& g, Vec3f wi, Vec3f wo) {
  if (wi.z <= 0 || std::abs(wo.z) <= kHorizon) return {};
  if (wo.z > 0) return mirrorLobe(g, wi, wo, false);
  return g.thin ? mirrorLobe(g, wi, {wo.x, wo.y, -wo.z}, true) : refractionLobe(g, wi, wo);
}

/// Refraction scales radiance against flux; nothing else does.
float scale(const Glass& g, Vec3f wo, Transport transport) {
  return transport == Transport::radiance && wo.z < 0 && !g.thin ? 1.f / (g.eta * g.eta) : 1.f;
}

/// Way on from a facet, with its density among the visible facets and G2/G1, what the weight keeps of it.
struct Way {
  Vec3f wo;
  float pdf, kept;
};

std::optional<Way> mirrorWay(const Glass& g, Vec3f wi, Vec3f h, bool transmits) {
  Vec3f wo = reflect(wi, h);
  if (wo.z <= kHorizon) return std::nullopt;
  const float in = lambda(wi, g.alpha), out = lambda(wo, g.alpha);
  if (transmits) wo.z = -wo.z;
  const float pdf = ggxD(h, g.alpha) / (4.f * std::max(wi.z, kHorizon) * (1.f + in));
  return Way{wo, pdf, (1.f + in) / (1.f + in + out)};
}

std::optional<Way> refractedWay(const Glass& g, Vec3f wi, Vec3f h, const Refraction& r) {
  const float cosI = dot(wi, h);
  const Vec3f wo = refract(wi, h, cosI, r.cosT, g.eta);
  if (wo.z >= -kHorizon) return std::nullopt;
  const float pdf = ggxD(h, g.alpha) * cosI * refractionJacobian(cosI, r.cosT, g.eta) /
                    (std::max(wi.z, kHorizon) * (1.f + lambda(wi, g.alpha)));
  return Way{wo, pdf, 1.f / (1.f + lambda(wo, g.alpha))};
}

}  // namespace

Rgb evaluate(const Glass& glass, Vec3f wi, Vec3f wo, Transport transport) {
  const Glass g = limit(glass);
  return lobe(g, wi, wo).f * scale(g, wo, transport);
}

float pdf(const Glass& glass, Vec3f wi, Vec3f wo) { return lobe(limit(glass), wi, wo).pdf; }

/// The weight is worked out without the density: f·|cos|/pdf = share · (G2/G1) / probability of the lobe.
std::optional<BsdfSample> sample(const Glass& glass, Vec3f wi, Vec3f u, Transport transport) {
  if (wi.z <= 0) return std::nullopt;
  const Glass g = limit(glass);
  const Vec3f h = sampleVisibleNormal(wi, g.alpha, {u.y, u.z});
  const float cosI = dot(wi, h);
  if (!(cosI > 0)) return std::nullopt;
  const Facet facet(g, refraction(cosI, g.eta));
  if (!(facet.sum() > 0)) return std::nullopt;
  const float reflects = facet.reflected / facet.sum();
  const bool transmits = u.x >= reflects;
  const auto way = transmits && !g.thin ? refractedWay(g, wi, h, facet.r) : mirrorWay(g, wi, h, transmits);
  if (!way) return std::nullopt;
  const float chosen = transmits ? facet.transmitted / facet.sum() : reflects;
  const Rgb share = transmits ? facet.transmission(g) : facet.reflection(g);
  const float pdf = chosen * way->pdf;
  if (!(pdf > 0)) return std::nullopt;
  return BsdfSample{way->wo, share * (way->kept / chosen * scale(g, way->wo, transport)), pdf};
}

Rgb albedo(const Glass& g, const GlassTable& table, Vec3f wi, bool inside) {
  if (wi.z <= 0) return {};
  const GlassTable::Albedo a = table.at(wi.z, g.alpha, inside);
  return g.reflectance * a.reflected + Rgb{a.totalInternal} + g.tint * a.transmitted;
}

}  // namespace lucarne
