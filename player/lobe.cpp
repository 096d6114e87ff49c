#include "player/lobe.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"

namespace lucarne {

float lobeWeight(float sharpness, float cosine) { return std::exp(std::max(sharpness * (cosine - 1.f), -60.f)); }

float meanWeight(float lobe, Vec3f r, Vec3f mean, int directionCount) {
  constexpr float kLeast = 1e-4f;
  const float length = std::max(std::sqrt(dot(mean, mean)), kLeast), light = meanSharpness(length, directionCount);
  const float sharpness = lobe * light / (lobe + light);
  return sharpness / (1 - std::exp(-2 * sharpness)) * lobeWeight(sharpness, dot(r, mean) / length);
}

float capCosine(int directionCount) { return 1.f - 2.f / static_cast<float>(directionCount); }

float phongDensity(float exponent, float cosine) {
  return (exponent + 1.f) * 0.5f * std::numbers::inv_pi_v<float> * std::pow(std::max(cosine, 0.f), exponent);
}

float phongDensityOverCap(float exponent, float cosine, float capCosine) {
  const float sine = std::sqrt(std::max(0.f, 1.f - cosine * cosine));
  const float capSine = std::sqrt(std::max(0.f, 1.f - capCosine * capCosine));
  const float c1 = cosine >= capCosine ? 1.f : cosine * capCosine + sine * capSine;
  const float c0 = cosine <= -capCosine ? -1.f : cosine * capCosine - sine * capSine;
  const auto integral = [&](float c) { return std::pow(std::max(c, 0.f), exponent + 1.f); };
  return 0.5f * std::numbers::inv_pi_v<float> * (integral(c1) - integral(c0)) / (c1 - c0);
}

Vec3f mirrorDirection(Vec3f normal, Vec3f toEye) {
  const Vec3f r = normal * (2.f * dot(normal, toEye)) - toEye;
  return normalize(r - normal * std::min(dot(normal, r), 0.f));
}

namespace {

/// Light from a direction this close to the horizon is taken as if it came a little from above.
constexpr float kLeastFacing = 0.02f;

Rgb unnormalised(const LobeView& view, float alpha, std::span<const LobeCell> cells, std::span<const Rgb> values) {
  const float exponent = phongFromAlpha(alpha), cap = capCosine(view.directionCount);
  const Vec3f r = mirrorDirection(view.normal, view.toEye);
  Rgb light{};
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const float cosine = dot(r, cells[k].direction);
    const float density =
        view.lobe == LobeKind::barsi ? phongDensityOverCap(exponent, cosine, cap) : phongDensity(exponent, cosine);
    light += values[k] * (density / std::max(dot(view.normal, cells[k].direction), kLeastFacing));
  }
  return light;
}

}  // namespace

Rgb mirroredRadiance(const LobeView& view, float alpha, std::span<const LobeCell> cells, std::span<const Rgb> values,
                     Rgb E) {
  LUCARNE_CHECK_EQ(cells.size(), values.size());
  if (view.lobe != LobeKind::cell && !cells.empty()) return unnormalised(view, alpha, cells, values);
  const float sharpness = lobeSharpness(alpha, view.directionCount, view.filter);
  const Vec3f r = mirrorDirection(view.normal, view.toEye);
  Rgb light{};
  float constant = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const float w = lobeWeight(sharpness, dot(r, cells[k].direction));
    light += values[k] * w;
    constant += cells[k].cosIntegral * w;
  }
  return constant > 0 ? light / constant : E * std::numbers::inv_pi_v<float>;
}

Rgb mirroredRadiance(const LobeView& view, float alpha, std::span<const MeanCell> cells, std::span<const Rgb> values,
                     std::span<const Vec3f> means, Rgb E) {
  LUCARNE_CHECK_EQ(cells.size(), values.size());
  LUCARNE_CHECK_EQ(cells.size(), means.size());
  const float lobe = coatSharpness(alpha);
  const Vec3f r = mirrorDirection(view.normal, view.toEye);
  Rgb light{};
  float constant = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    light += values[k] * meanWeight(lobe, r, means[k], view.directionCount);
    constant += cells[k].cosIntegral * meanWeight(lobe, r, cells[k].direction, view.directionCount);
  }
  return constant > 0 ? light / constant : E * std::numbers::inv_pi_v<float>;
}

namespace {

Rgb composed(const LobeView& view, const Bsdf& bsdf, Rgb E, Rgb mirrored) {
  const float cosine = std::clamp(dot(view.normal, view.toEye), 0.f, 1.f);
  const CoatAlbedo coat = Coat(bsdf).albedo(cosine);
  const Rgb diffuse = (bsdf.diffuse * coat.passed() + coat.more()) * std::numbers::inv_pi_v<float>;
  return diffuse * E + coat.once * mirrored;
}

}  // namespace

Rgb reflectedRadiance(const LobeView& view, const Bsdf& bsdf, std::span<const LobeCell> cells,
                      std::span<const Rgb> values, Rgb E) {
  return composed(view, bsdf, E, mirroredRadiance(view, bsdf.alpha, cells, values, E));
}

Rgb reflectedRadiance(const LobeView& view, const Bsdf& bsdf, std::span<const MeanCell> cells,
                      std::span<const Rgb> values, std::span<const Vec3f> means, Rgb E) {
  return composed(view, bsdf, E, mirroredRadiance(view, bsdf.alpha, cells, values, means, E));
}

}  // namespace lucarne
