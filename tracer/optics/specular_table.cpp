#include "tracer/optics/specular_table.h"

#include <cmath>

#include "tracer/optics/ggx.h"

namespace lucarne {
namespace {

constexpr int kQuadrature = 20;  // midpoint rule in the primary space of the visible-normal sampler, squared

/// ρ(w) = ∫ f·cos dwo = E[F·G2/G1] over visible normals (pdf cancels D, the Jacobian and G1; see ggx.h).
Vec2f integrate(float cosTheta, float alpha) {
  const float c = std::max(cosTheta, 1e-3f);
  const Vec3f w{std::sqrt(1.f - c * c), 0, c};
  double x = 0, y = 0;
  for (int i = 0; i < kQuadrature; ++i) {
    for (int j = 0; j < kQuadrature; ++j) {
      const Vec2f u{(static_cast<float>(i) + 0.5f) / kQuadrature, (static_cast<float>(j) + 0.5f) / kQuadrature};
      const Vec3f h = sampleVisibleNormal(w, alpha, u);
      const Vec3f wo = reflect(w, h);
      if (wo.z <= 0) continue;
      const double g = ggxG2(w.z, wo.z, alpha) / ggxG1(w.z, alpha);
      const double f = schlick(dot(w, h));
      x += g * (1 - f);
      y += g * f;
    }
  }
  constexpr double n = kQuadrature * kQuadrature;
  return {static_cast<float>(x / n), static_cast<float>(y / n)};
}

struct Cell {
  int i;
  float f;
};
Cell locate(float unit) {
  const float x = std::clamp(unit, 0.f, 1.f) * (SpecularTable::kSize - 1);
  const int i = std::min(static_cast<int>(x), SpecularTable::kSize - 2);
  return {i, x - static_cast<float>(i)};
}

}  // namespace

SpecularTable::SpecularTable() : directional_(kSize * kSize), mean_(kSize) {
  for (int j = 0; j < kSize; ++j) {
    const float roughness = static_cast<float>(j) / (kSize - 1);
    const float alpha = std::max(roughness * roughness, kMinAlpha);
    Vec2d sum{};
    for (int i = 0; i < kSize; ++i) {
      const float mu = static_cast<float>(i) / (kSize - 1);
      const Vec2f v = integrate(mu, alpha);
      directional_[static_cast<std::size_t>(j * kSize + i)] = v;
      // Trapezoid for 2∫ρμ dμ; the end at μ = 1 counts half.
      const double weight = 2.0 * mu / (kSize - 1) * (i == kSize - 1 ? 0.5 : 1.0);
      sum = sum + Vec2d{v.x * weight, v.y * weight};
    }
    mean_[static_cast<std::size_t>(j)] = {static_cast<float>(sum.x), static_cast<float>(sum.y)};
  }
}

Vec2f SpecularTable::scaleBias(float cosTheta, float alpha) const {
  const Cell c = locate(cosTheta), r = locate(std::sqrt(alpha));
  const Vec2f* row = directional_.data() + r.i * kSize + c.i;
  const Vec2f a = row[0] * (1 - c.f) + row[1] * c.f;
  const Vec2f b = row[kSize] * (1 - c.f) + row[kSize + 1] * c.f;
  return a * (1 - r.f) + b * r.f;
}

Vec2f SpecularTable::meanScaleBias(float alpha) const {
  const Cell r = locate(std::sqrt(alpha));
  const Vec2f* row = mean_.data() + r.i;
  return row[0] * (1 - r.f) + row[1] * r.f;
}

const SpecularTable& SpecularTable::instance() {
  static const SpecularTable table;
  return table;
}

}  // namespace lucarne
