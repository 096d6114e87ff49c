#include "tracer/optics/bsdf.h"

#include "tracer/optics/ggx.h"
#include "tracer/optics/specular_table.h"
#include "tracer/optics/warp.h"

namespace lucarne {
namespace {

Rgb coatAlbedo(const Bsdf& b, float cosTheta) {
  const Vec2f sb = SpecularTable::instance().scaleBias(cosTheta, b.alpha);
  return b.f0 * sb.x + b.f90 * sb.y;
}

float meanCoat(const Bsdf& b) {
  const Vec2f sb = SpecularTable::instance().meanScaleBias(b.alpha);
  return std::min(maxComponent(b.f0 * sb.x + b.f90 * sb.y), 0.999f);
}

/// Probability of sampling the coat: its share of the albedo. Never 0 or 1 while both lobes reflect.
float coatProbability(const Bsdf& b, Rgb coat, float base) {
  const float s = mean(coat), d = mean(b.diffuse) * base;
  return d <= 0 ? 1.f : s / (s + d);
}

struct Evaluation {
  Rgb f;
  float pdf;
};

Evaluation evaluateBoth(const Bsdf& b, Vec3f wi, Vec3f wo, Rgb coatIn) {
  const float baseIn = std::max(0.f, 1.f - maxComponent(coatIn));
  const float baseOut = std::max(0.f, 1.f - maxComponent(coatAlbedo(b, wo.z)));
  const Vec3f h = normalize(wi + wo);
  const float d = ggxD(h.z, b.alpha);
  const float c = schlick(dot(wi, h));
  const Rgb fresnel = b.f0 * (1.f - c) + b.f90 * c;
  const Rgb coat = fresnel * (d * ggxG2(wi.z, wo.z, b.alpha) / (4.f * wi.z * wo.z));
  const Rgb base = b.diffuse * (baseIn * baseOut / (kPi * (1.f - meanCoat(b))));
  const float p = coatProbability(b, coatIn, baseIn);
  return {coat + base, p * pdfVisibleReflection(wi, h, b.alpha) + (1 - p) * pdfCosineHemisphere(wo)};
}

}  // namespace

Rgb evaluate(const Bsdf& b, Vec3f wi, Vec3f wo) {
  if (wi.z <= 0 || wo.z <= 0) return {};
  if (b.lambert()) return b.diffuse * (1.f / kPi);
  return evaluateBoth(b, wi, wo, coatAlbedo(b, wi.z)).f;
}

float pdf(const Bsdf& b, Vec3f wi, Vec3f wo) {
  if (wi.z <= 0 || wo.z <= 0) return 0;
  if (b.lambert()) return pdfCosineHemisphere(wo);
  return evaluateBoth(b, wi, wo, coatAlbedo(b, wi.z)).pdf;
}

std::optional<BsdfSample> sample(const Bsdf& b, Vec3f wi, Vec3f u) {
  if (wi.z <= 0) return std::nullopt;
  if (b.lambert()) {  // f·cos/pdf = (c/π)·cos/(cos/π) = c
    const Vec3f wo = sampleCosineHemisphere({u.y, u.z});
    if (wo.z <= 0) return std::nullopt;
    return BsdfSample{wo, b.diffuse, pdfCosineHemisphere(wo)};
  }
  const Rgb coatIn = coatAlbedo(b, wi.z);
  const float p = coatProbability(b, coatIn, std::max(0.f, 1.f - maxComponent(coatIn)));
  const Vec3f wo = u.x < p ? reflect(wi, sampleVisibleNormal(wi, b.alpha, {u.y, u.z})) : sampleCosineHemisphere({u.y, u.z});
  if (wo.z <= 1e-6f) return std::nullopt;
  const Evaluation e = evaluateBoth(b, wi, wo, coatIn);
  if (!(e.pdf > 0)) return std::nullopt;
  return BsdfSample{wo, e.f * (wo.z / e.pdf), e.pdf};
}

Rgb albedo(const Bsdf& b, Vec3f wi) {
  if (wi.z <= 0) return {};
  if (b.lambert()) return b.diffuse;
  const Rgb coat = coatAlbedo(b, wi.z);
  return coat + b.diffuse * std::max(0.f, 1.f - maxComponent(coat));
}

}  // namespace lucarne
