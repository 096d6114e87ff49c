#include "tracer/optics/bsdf.h"

#include "tracer/optics/coat.h"
#include "tracer/optics/ggx.h"

namespace lucarne {
namespace {

/// Probability of sampling the coat's single bounce: its share of the albedo. Never 0 or 1 while both kinds reflect.
float coatProbability(const Bsdf& b, const CoatAlbedo& in) {
  const float s = mean(in.once), d = mean(b.diffuse) * in.passed() + mean(in.more());
  return d <= 0 ? 1.f : s / (s + d);
}

struct Evaluation {
  Rgb f;
  float pdf;
};

/// G1 and G2 share Λ(wi); D is common to value and density.
Evaluation evaluateBoth(const Bsdf& b, const Coat& coat, Vec3f wi, Vec3f wo, const CoatAlbedo& in) {
  const Vec3f h = normalize(wi + wo);
  const float d = ggxD(h, b.alpha) / (4.f * wi.z);
  const float lambdaIn = ggxLambda(wi.z, b.alpha), lambdaOut = ggxLambda(wo.z, b.alpha);
  const float c = schlick(dot(wi, h));
  const Rgb fresnel = b.f0 * (1.f - c) + b.f90 * c;
  const Rgb once = fresnel * (d / ((1.f + lambdaIn + lambdaOut) * wo.z));
  const CoatAlbedo out = coat.albedo(wo.z);
  const Rgb more = coat.multiple() * (in.lost * out.lost / coat.meanLost());
  const Rgb base = b.diffuse * (in.passed() * out.passed() / coat.meanPassed());
  const float p = coatProbability(b, in);
  return {once + (more + base) * (1.f / kPi), p * d / (1.f + lambdaIn) + (1 - p) * pdfCosineHemisphere(wo)};
}

Evaluation evaluateBoth(const Bsdf& b, Vec3f wi, Vec3f wo) {
  const Coat coat(b);
  return evaluateBoth(b, coat, wi, wo, coat.albedo(wi.z));
}

std::optional<BsdfSample> sampleDirection(const Bsdf& b, const Coat& coat, const CoatAlbedo& in, Vec3f wi, Vec3f u) {
  const float p = coatProbability(b, in);
  const Vec3f wo =
      u.x < p ? reflect(wi, sampleVisibleNormal(wi, b.alpha, {u.y, u.z})) : sampleCosineHemisphere({u.y, u.z});
  if (wo.z <= 1e-6f) return std::nullopt;
  const Evaluation e = evaluateBoth(b, coat, wi, wo, in);
  if (!(e.pdf > 0)) return std::nullopt;
  return BsdfSample{wo, e.f * (wo.z / e.pdf), e.pdf};
}

}  // namespace

Rgb evaluate(const Bsdf& b, Vec3f wi, Vec3f wo) {
  if (wi.z <= 0 || wo.z <= 0) return {};
  if (b.lambert()) return b.diffuse * (1.f / kPi);
  return evaluateBoth(b, wi, wo).f;
}

float pdf(const Bsdf& b, Vec3f wi, Vec3f wo) {
  if (wi.z <= 0 || wo.z <= 0) return 0;
  if (b.lambert()) return pdfCosineHemisphere(wo);
  return evaluateBoth(b, wi, wo).pdf;
}

std::optional<BsdfSample> sample(const Bsdf& b, Vec3f wi, Vec3f u) { return sampleWithAlbedo(b, wi, u).sample; }

SampleWithAlbedo sampleWithAlbedo(const Bsdf& b, Vec3f wi, Vec3f u) {
  if (wi.z <= 0) return {};
  if (b.lambert()) {
    const Vec3f wo = sampleLambert({u.y, u.z});
    if (wo.z <= 0) return {std::nullopt, b.diffuse};
    return {BsdfSample{wo, b.diffuse, pdfCosineHemisphere(wo)}, b.diffuse};
  }
  return sampleCoated(b, Coat(b), wi, u);
}

SampleWithAlbedo sampleCoated(const Bsdf& b, const Coat& coat, Vec3f wi, Vec3f u) {
  if (wi.z <= 0) return {};
  const CoatAlbedo in = coat.albedo(wi.z);
  return {sampleDirection(b, coat, in, wi, u), in.total + b.diffuse * in.passed()};
}

Rgb albedo(const Bsdf& b, Vec3f wi) {
  if (wi.z <= 0) return {};
  if (b.lambert()) return b.diffuse;
  const CoatAlbedo in = Coat(b).albedo(wi.z);
  return in.total + b.diffuse * in.passed();
}

}  // namespace lucarne
