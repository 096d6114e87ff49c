// The photon tracer. Photon i is a pure function of (scene, seed, i); what it does at its hits is the sink's business.
//
// A sink has `void hit(const PhotonHit&)`, called at every hit on a lit side (front, or back of a double-sided
// material), and `void endPhoton()`, called once after each photon.
#pragma once

#include <cstdint>

#include "tracer/optics/sampler.h"
#include "tracer/transport/ledger.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

struct IndexRange {
  std::uint64_t begin = 0, end = 0;
  std::uint64_t size() const { return end - begin; }
};

struct PhotonHit {
  const Hit& hit;
  std::uint32_t event;  // 1 is the first hit: direct light
  // The numbers of this event. Scattering uses the top 24 bits of each; the low 8 are free for rounding.
  const std::array<std::uint32_t, 4>& words;
  Rgb beta;             // incident flux as a fraction of the emitted flux
  Vec3f wi;             // unit, away from the surface toward where the light came from
  Vec3f n, ns;          // geometric and shading normal of the side hit
};

struct TraceLimits {
  // A closed white room still ends. At albedo 0.9 the light past bound d is 0.9^d: 1e-47.
  std::uint32_t depth = 1024;
};

/// Corrections by shading normals are clamped to this; how often is counted, how much is booked.
inline constexpr float kLargestShadingCorrection = 4;

/// |ns·wi| / |n·wi|: what the interpolated surface receives of light that falls on the flat one.
inline float shadingReception(Vec3f wi, Vec3f n, Vec3f ns) { return std::abs(dot(ns, wi)) / std::max(std::abs(dot(n, wi)), 1e-6f); }

namespace detail {

/// What one photon adds to the ledger; 64 bits hold any single path.
struct PathLedger {
  FixedRgb absorbed, expectedAbsorbed, roulette, shadingNormal;

  void addTo(Ledger& ledger) const {
    ledger.absorbed += absorbed;
    ledger.expectedAbsorbed += expectedAbsorbed;
    ledger.roulette += roulette;
    ledger.shadingNormal += shadingNormal;
    const FixedRgb error = absorbed - expectedAbsorbed;
    const Int128 sum = Int128{error.units[0]} + error.units[1] + error.units[2];
    ledger.absorptionErrorSquares += sum * sum;
  }
};

template <class Sink>
class PhotonPath {
 public:
  PhotonPath(const PhotonScene& scene, const PhotonSampler& sampler, const TraceLimits& limits, Sink& sink, Ledger& ledger)
      : scene_(scene), sampler_(sampler), limits_(limits), sink_(sink), ledger_(ledger) {}

  void trace() {
    emit();
    for (std::uint32_t event = 1; step(event); ++event) {
      if (event >= limits_.depth) {
        ledger_.cutOff += fixed_;
        ++ledger_.cutOffPaths;
        break;
      }
    }
    path_.addTo(ledger_);
    ++ledger_.photons;
    sink_.endPhoton();
  }

 private:
  void emit() {
    const auto pick = sampler_.words(0, Stream::emitter);
    const auto u = sampler_.floats(0, Stream::emission);
    const EmittedPhoton photon = scene_.emitters().sample(
        {toUnitDouble(pick[0], pick[1]), toUnitFloat(pick[2]), {u[0], u[1]}, {u[2], u[3]}});
    setBeta(sane(photon.beta));
    ledger_.emitted += fixed_;
    reference_ = maxComponent(beta_);
    from_ = photon.triangle;
    origin_ = from_ == kNone ? Vec3f(photon.position) : RayCaster::leave(photon.position, photon.normal);
    direction_ = photon.direction;
  }

  /// One segment and what happens at its end. False when the path is over.
  bool step(std::uint32_t event) {
    ++ledger_.rays;
    const auto hit = scene_.rayCaster().nearest(origin_, direction_, from_, ledger_.repeatedRays);
    if (!hit) {
      ledger_.escaped += fixed_;
      return false;
    }
    ++ledger_.hits;
    if (hit->back && !scene_.surfaces().doubleSided(hit->material)) {  // an opaque, black back
      path_.absorbed += fixed_;
      path_.expectedAbsorbed += fixed_;
      return false;
    }
    const Vec3f wi = -direction_, n = hit->back ? -hit->n : hit->n;
    const Vec3f ns = scene_.shadingNormal(*hit, n, wi);
    const auto words = sampler_.words(event, Stream::scatter);
    sink_.hit(PhotonHit{*hit, event, words, beta_, wi, n, ns});
    return scatter(*hit, words, wi, n, ns);
  }

  bool scatter(const Hit& hit, const std::array<std::uint32_t, 4>& words, Vec3f wi, Vec3f n, Vec3f ns) {
    const Bsdf bsdf = scene_.surfaces().bsdf(hit.material, hit.triangle, hit.b);
    const Frame<float> frame(ns);
    const Vec3f wiLocal = frame.toLocal(wi);
    const auto sampled = sample(bsdf, wiLocal, {toUnitFloat(words[0]), toUnitFloat(words[1]), toUnitFloat(words[2])});
    const Rgb onward = sampled ? sane(beta_ * sampled->weight) : Rgb{};
    const FixedRgb fixedOnward(onward);
    const FixedRgb absorbed = fixed_ - fixedOnward;
    path_.absorbed += absorbed;
    path_.expectedAbsorbed += bsdf.lambert() && sampled ? absorbed : fixed_ - FixedRgb(sane(beta_ * albedo(bsdf, wiLocal)));
    if (!sampled) return false;
    const Vec3f wo = frame.toWorld(sampled->wo);
    if (!goOn(onward, fixedOnward, toUnitFloat(words[3]), wi, wo, n, ns)) return false;
    from_ = hit.triangle;
    origin_ = RayCaster::leave(hit.position, n);
    direction_ = normalize(wo);
    return true;
  }

  bool goOn(Rgb onward, const FixedRgb& fixedOnward, float u, Vec3f wi, Vec3f wo, Vec3f n, Vec3f ns) {
    if (ns == n) return roulette(onward, fixedOnward, u);
    const Rgb corrected = onward * shadingCorrection(wi, wo, n, ns);
    const FixedRgb fixedCorrected(corrected);
    path_.shadingNormal += fixedOnward - fixedCorrected;
    return roulette(corrected, fixedCorrected, u);
  }

  /// Interpolated normals make the BSDF non-symmetric; light carries the adjoint one, f · |wi·ns||wo·n| / (|wi·n||wo·ns|)
  /// (Veach 1997, equation 5.19), and none goes through the surface.
  float shadingCorrection(Vec3f wi, Vec3f wo, Vec3f n, Vec3f ns) {
    const float woN = dot(wo, n);
    if (woN <= 0) return 0;
    const float factor = shadingReception(wi, n, ns) * woN / std::max(std::abs(dot(wo, ns)), 1e-6f);
    if (factor <= kLargestShadingCorrection) return factor;
    ++ledger_.clampedNormals;
    return kLargestShadingCorrection;
  }

  /// Survival in proportion to what is left of the photon, so that beta stays nearly constant.
  bool roulette(Rgb onward, const FixedRgb& fixedOnward, float u) {
    const float left = maxComponent(onward);
    const float p = left < reference_ ? left / reference_ : 1.f;
    if (!(left > 0) || !(u < p)) {
      path_.roulette += fixedOnward;
      return false;
    }
    setBeta(sane(onward * (1.f / p)));
    path_.roulette += fixedOnward - fixed_;
    return true;
  }

  void setBeta(Rgb beta) {
    beta_ = beta;
    fixed_ = FixedRgb(beta);
  }

  /// Numbers that no arithmetic should give are counted and dropped, never passed on.
  Rgb sane(Rgb beta) {
    constexpr float kLargest = 0x1p24f;  // far above what roulette lets grow; keeps a path's sums in 64 bits
    const auto good = [](float v) { return v >= 0 && v <= kLargest; };  // false for NaN
    if (good(beta.x) && good(beta.y) && good(beta.z)) return beta;
    ++ledger_.strayValues;
    return {};
  }

  const PhotonScene& scene_;
  const PhotonSampler& sampler_;
  const TraceLimits& limits_;
  Sink& sink_;
  Ledger& ledger_;
  PathLedger path_;
  Rgb beta_{};
  FixedRgb fixed_;  // beta_ in fixed point
  float reference_ = 1;
  Vec3f origin_{}, direction_{};
  std::uint32_t from_ = kNone;
};

}  // namespace detail

/// Traces the photons of `range`. Nothing happens when the scene emits no light.
template <class Sink>
void tracePhotons(const PhotonScene& scene, IndexRange range, std::uint64_t seed, const TraceLimits& limits, Sink& sink,
                  Ledger& ledger) {
  if (scene.emitters().empty()) return;
  for (std::uint64_t i = range.begin; i < range.end; ++i) {
    const PhotonSampler sampler(seed, i);
    detail::PhotonPath<Sink>(scene, sampler, limits, sink, ledger).trace();
  }
}

}  // namespace lucarne
