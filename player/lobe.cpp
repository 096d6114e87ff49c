#include "player/lobe.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"

namespace lucarne {

float cellSharpness(int directionCount) { return 1.2f * static_cast<float>(directionCount); }

float lobeSharpness(float alpha, int directionCount) {
  const float lobe = phongFromAlpha(alpha) + 1.f, cell = cellSharpness(directionCount);
  return lobe * cell / (lobe + cell);
}

float lobeWeight(float sharpness, float cosine) { return std::exp(std::max(sharpness * (cosine - 1.f), -60.f)); }

Vec3f mirrorDirection(Vec3f normal, Vec3f toEye) {
  const Vec3f r = normal * (2.f * dot(normal, toEye)) - toEye;
  return normalize(r - normal * std::min(dot(normal, r), 0.f));
}

Rgb mirroredRadiance(const LobeView& view, float alpha, std::span<const LobeCell> cells, std::span<const Rgb> values,
                     Rgb E) {
  LUCARNE_CHECK_EQ(cells.size(), values.size());
  const float sharpness = lobeSharpness(alpha, view.directionCount);
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

Rgb reflectedRadiance(const LobeView& view, const Bsdf& bsdf, std::span<const LobeCell> cells,
                      std::span<const Rgb> values, Rgb E) {
  const float cosine = std::clamp(dot(view.normal, view.toEye), 0.f, 1.f);
  const CoatAlbedo coat = Coat(bsdf).albedo(cosine);
  const Rgb diffuse = (bsdf.diffuse * coat.passed() + coat.more()) * std::numbers::inv_pi_v<float>;
  return diffuse * E + coat.once * mirroredRadiance(view, bsdf.alpha, cells, values, E);
}

}  // namespace lucarne
