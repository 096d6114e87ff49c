#include "tracer/optics/bsdf.h"

#include "tracer/optics/ggx.h"
#include "tracer/optics/specular_table.h"

namespace lucarne {
namespace {

/// The coat at one roughness: its row of the table is found once for all directions of a hit.
class Coat {
 public:
  explicit Coat(const Bsdf& b) : b_(b), row_(SpecularTable::instance().row(b.alpha)) {}

  Rgb albedo(float cosTheta) const {
    const Vec2f sb = row_.scaleBias(cosTheta);
    return b_.f0 * sb.x + b_.f90 * sb.y;
  }
  float mean() const {
    const Vec2f sb = row_.meanScaleBias();
    return std::min(maxComponent(b_.f0 * sb.x + b_.f90 * sb.y), 0.999f);
  }

 private:
  const Bsdf& b_;
  SpecularTable::Row row_;
};

/// What the coat lets through to the base.
float passed(Rgb coatAlbedo) { return std::max(0.f, 1.f - maxComponent(coatAlbedo)); }

/// Probability of sampling the coat: its share of the albedo. Never 0 or 1 while both lobes reflect.
float coatProbability(const Bsdf& b, Rgb coat, float base) {
  const float s = mean(coat), d = mean(b.diffuse) * base;
  return d <= 0 ? 1.f : s / (s + d);
}

struct Evaluation {
  Rgb f;
  float pdf;
};

/// G1 and G2 share Λ(wi); D is common to value and density.
Evaluation evaluateBoth(const Bsdf& b, const Coat& coat, Vec3f wi, Vec3f wo, Rgb coatIn) {
  const float baseIn = passed(coatIn);
  const Vec3f h = normalize(wi + wo);
  const float d = ggxD(h.z, b.alpha) / (4.f * wi.z);
  const float lambdaIn = ggxLambda(wi.z, b.alpha), lambdaOut = ggxLambda(wo.z, b.alpha);
  const float c = schlick(dot(wi, h));
  const Rgb fresnel = b.f0 * (1.f - c) + b.f90 * c;
  const Rgb specular = fresnel * (d / ((1.f + lambdaIn + lambdaOut) * wo.z));
  const float p = coatProbability(b, coatIn, baseIn);
  const float coatPdf = d / (1.f + lambdaIn);
  if (maxComponent(b.diffuse) <= 0) return {specular, coatPdf};  // a metal: p = 1
  const Rgb base = b.diffuse * (baseIn * passed(coat.albedo(wo.z)) / (kPi * (1.f - coat.mean())));
  return {specular + base, p * coatPdf + (1 - p) * pdfCosineHemisphere(wo)};
}

Evaluation evaluateBoth(const Bsdf& b, Vec3f wi, Vec3f wo) {
  const Coat coat(b);
  return evaluateBoth(b, coat, wi, wo, coat.albedo(wi.z));
}

std::optional<BsdfSample> sampleCoated(const Bsdf& b, const Coat& coat, Rgb coatIn, Vec3f wi, Vec3f u) {
  const float p = coatProbability(b, coatIn, passed(coatIn));
  const Vec3f wo =
      u.x < p ? reflect(wi, sampleVisibleNormal(wi, b.alpha, {u.y, u.z})) : sampleCosineHemisphere({u.y, u.z});
  if (wo.z <= 1e-6f) return std::nullopt;
  const Evaluation e = evaluateBoth(b, coat, wi, wo, coatIn);
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
  const Coat coat(b);
  const Rgb coatIn = coat.albedo(wi.z);
  return {sampleCoated(b, coat, coatIn, wi, u), coatIn + b.diffuse * passed(coatIn)};
}

Rgb albedo(const Bsdf& b, Vec3f wi) {
  if (wi.z <= 0) return {};
  if (b.lambert()) return b.diffuse;
  const Rgb coat = Coat(b).albedo(wi.z);
  return coat + b.diffuse * passed(coat);
}

}  // namespace lucarne
