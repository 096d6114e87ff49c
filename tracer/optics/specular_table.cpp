#include "tracer/optics/specular_table.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "tracer/optics/ggx.h"

namespace lucarne {
namespace {

constexpr int kQuadrature = 48;

/// ρ(w) = ∫ f·cos dwo = E[F·G2/G1] over visible normals (pdf cancels D, the Jacobian and G1; see ggx.h).
///
/// Midpoint rule over the sampler's unit square. The far tail of the lobe lies at u ≈ 1, so u = 1 − (1−t)², du = 2(1−t)
/// dt, spends points there; the lobe is symmetric about the plane of w and n, so half the azimuths do. Within 5e-4
/// everywhere, 1e-4 for α > 0.1 (against a million points).
Vec2f integrate(float cosTheta, float alpha) {
  const float c = std::max(cosTheta, 1e-3f);
  const Vec3f w{std::sqrt(1.f - c * c), 0, c};
  double x = 0, y = 0;
  for (int i = 0; i < kQuadrature; ++i) {
    const float rest = 1 - (static_cast<float>(i) + 0.5f) / kQuadrature;
    for (int j = 0; j < kQuadrature; ++j) {
      const float quarterTurns =
          (static_cast<float>(j) + 0.5f) / kQuadrature - 0.5f;  // azimuth −¼ … ¼ turn, brought to [0, 1)
      const float turns = 0.5f * quarterTurns + (quarterTurns < 0 ? 1.f : 0.f);
      const Vec3f h = sampleVisibleNormal(w, alpha, {1 - rest * rest, turns});
      const Vec3f wo = reflect(w, h);
      if (wo.z <= 0) continue;
      const double g = 2.0 * static_cast<double>(rest * ggxG2(w.z, wo.z, alpha) / ggxG1(w.z, alpha));
      const double f = static_cast<double>(schlick(dot(w, h)));
      x += g * (1 - f);
      y += g * f;
    }
  }
  constexpr double n = kQuadrature * kQuadrature;
  return {static_cast<float>(x / n), static_cast<float>(y / n)};
}

}  // namespace

SpecularTable::SpecularTable() : directional_(kCosines * kRoughnesses), mean_(kRoughnesses) {
  tbb::parallel_for(0, kRoughnesses, [this](int j) {
    const float roughness = static_cast<float>(j) / (kRoughnesses - 1);
    const float alpha = std::max(roughness * roughness, kMinAlpha);
    Vec2d sum{};
    for (int i = 0; i < kCosines; ++i) {
      const float mu = static_cast<float>(i) / (kCosines - 1);
      const Vec2f v = integrate(mu, alpha);
      directional_[static_cast<std::size_t>(j * kCosines + i)] = v;
      // Trapezoid for 2∫ρμ dμ; the end at μ = 1 counts half.
      const double weight = 2.0 * static_cast<double>(mu) / (kCosines - 1) * (i == kCosines - 1 ? 0.5 : 1.0);
      sum = sum + Vec2d{static_cast<double>(v.x) * weight, static_cast<double>(v.y) * weight};
    }
    mean_[static_cast<std::size_t>(j)] = {static_cast<float>(sum.x), static_cast<float>(sum.y)};
  });
}

const SpecularTable& SpecularTable::instance() {
  static const SpecularTable table;
  return table;
}

}  // namespace lucarne
