// The GGX coat of a surface at one roughness: how much it reflects, after one bounce among its facets and after more.
//
// One bounce reflects ρ₁(μ) = F0·x + F90·y (specular_table.h) and, were the facets perfect mirrors, E(μ) = x + y. The
// rest, 1 − E, is shadowed by other facets and leaves after more bounces. It comes back as a diffuse-like lobe (Kulla
// and Conty 2017, "Revisiting physically based shading at Imageworks"):
//
//   f_m = F_m · (1 − E(μi)) · (1 − E(μo)) / (π (1 − Ē)),   F_m = F̄² Ē / (1 − F̄ (1 − Ē)),   F̄ = F0 + (F90 − F0)/21
//
// with albedo F_m·(1 − E(μ)), so that a white metal reflects everything at every roughness and angle: constant light
// gives a constant highlight.
#pragma once

#include "tracer/optics/bsdf.h"
#include "tracer/optics/specular_table.h"

namespace lucarne {

/// What the coat does with light at one angle.
struct CoatAlbedo {
  Rgb once, total;  // reflected after one bounce; after any number
  float lost = 0;   // 1 − E: share that meets more than one facet

  Rgb more() const { return total - once; }
  /// What it lets through to the base.
  float passed() const { return std::max(0.f, 1.f - maxComponent(total)); }
};

class Coat {
 public:
  explicit Coat(const Bsdf& b) : f0_(b.f0), f90_(b.f90), row_(SpecularTable::instance().row(b.alpha)) {
    const Vec2f mean = row_.meanScaleBias();
    const float whole = std::min(mean.x + mean.y, 1.f);
    const auto multiple = [&](float f0, float f90) {
      const float f = f0 + (f90 - f0) / 21.f;
      return f * f * whole / (1.f - f * (1.f - whole));
    };
    multiple_ = {multiple(f0_.x, f90_.x), multiple(f0_.y, f90_.y), multiple(f0_.z, f90_.z)};
    meanLost_ = std::max(1.f - whole, 1e-6f);
    meanPassed_ = std::max(1.f - maxComponent(f0_ * mean.x + f90_ * mean.y + multiple_ * (1.f - whole)), 1e-3f);
  }

  CoatAlbedo albedo(float cosTheta) const {
    const Vec2f sb = row_.scaleBias(cosTheta);
    const Rgb once = f0_ * sb.x + f90_ * sb.y;
    const float lost = std::max(0.f, 1.f - sb.x - sb.y);
    return {once, once + multiple_ * lost, lost};
  }
  /// F_m.
  Rgb multiple() const { return multiple_; }
  /// Means over the hemisphere of CoatAlbedo::lost and of passed().
  float meanLost() const { return meanLost_; }
  float meanPassed() const { return meanPassed_; }

 private:
  Rgb f0_, f90_, multiple_;
  SpecularTable::Row row_;
  float meanLost_, meanPassed_;
};

/// sampleWithAlbedo() of a surface that is not Lambert, with its coat at hand.
SampleWithAlbedo sampleCoated(const Bsdf& bsdf, const Coat& coat, Vec3f wi, Vec3f u);

}  // namespace lucarne
