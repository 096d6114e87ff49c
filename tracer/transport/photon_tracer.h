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
  Rgb beta;     // incident flux as a fraction of the emitted flux
  Vec3f wi;     // unit, away from the surface toward where the light came from
  Vec3f n, ns;  // geometric and shading normal of the side hit
};

struct TraceLimits {
  // A closed white room still ends. At albedo 0.9 the light past bound d is 0.9^d: 1e-47.
  std::uint32_t depth = 1024;
};

/// Corrections by shading normals are clamped to this; how often is counted, how much is booked.
inline constexpr float kLargestShadingCorrection = 4;

/// |ns·wi| / |n·wi|: what the interpolated surface receives of light that falls on the flat one.
inline float shadingReception(Vec3f wi, Vec3f n, Vec3f ns) {
  return std::abs(dot(ns, wi)) / std::max(std::abs(dot(n, wi)), 1e-6f);
}

namespace detail {

/// What one photon adds to the ledger; 64 bits hold any single path.
struct PathLedger {
  FixedRgb absorbed, roulette, shadingNormal;
  FixedRgb error;  // absorbed − expected absorbed: zero at diffuse surfaces

  void addTo(Ledger& ledger) const {
    ledger.absorbed += absorbed;
    ledger.expectedAbsorbed += absorbed - error;
    ledger.roulette += roulette;
    ledger.shadingNormal += shadingNormal;
    const Int128 sum = Int128{error.units[0]} + error.units[1] + error.units[2];
    ledger.absorptionErrorSquares += sum * sum;
  }
};

template <class Sink>
class PhotonPath {
 public:
  PhotonPath(const PhotonScene& scene, const PhotonSampler& sampler, const TraceLimits& limits, Sink& sink,
             Ledger& ledger)
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
  [[gnu::always_inline]] void emit() {
    const auto pick = sampler_.words(0, Stream::emitter);
    const auto u = sampler_.floats(0, Stream::emission);
    const EmittedPhoton photon =
        scene_.emitters().sample({toUnitDouble(pick[0], pick[1]), toUnitFloat(pick[2]), {u[0], u[1]}, {u[2], u[3]}});
    setBeta(sane(photon.beta));
    ledger_.emitted += fixed_;
    reference_ = maxComponent(beta_);
    from_ = photon.triangle;
    origin_ = from_ == kNone ? Vec3f(photon.position) : RayCaster::leave(photon.position, photon.normal);
    direction_ = photon.direction;
  }

  /// One segment and what happens at its end. False when the path is over.
  [[gnu::always_inline]] bool step(std::uint32_t event) {
    ++ledger_.rays;
    const RayCaster& caster = scene_.rayCaster();
    std::uint32_t triangle = caster.nearest(origin_, direction_, from_, ledger_.repeatedRays);
    if (triangle == kNone) return escape();
    Hit hit = caster.intersect(triangle, origin_, direction_);
    if (blackBack(hit) || lampOn(hit)) [[unlikely]] {
      triangle = caster.past(triangle, origin_, direction_, from_, ledger_.repeatedRays);
      if (triangle == kNone) return escape();
      hit = caster.intersect(triangle, origin_, direction_);
      if (blackBack(hit)) {
        ++ledger_.hits;
        path_.absorbed += fixed_;
        return false;
      }
    }
    ++ledger_.hits;
    const Vec3f wi = -direction_, n = hit.back ? -hit.n : hit.n;
    const Vec3f ns = scene_.shadingNormal(hit, n, wi);
    const auto words = sampler_.words(event, Stream::scatter);
    sink_.hit(PhotonHit{hit, event, words, beta_, wi, n, ns});
    if (!scatter(hit, words, wi, n, ns)) return false;
    from_ = triangle;
    origin_ = RayCaster::leave(hit.position, n);
    return true;
  }

  /// Backs of one-sided triangles are opaque and black.
  [[gnu::always_inline]] bool blackBack(const Hit& hit) const {
    return hit.back && !scene_.surfaces().doubleSided(hit.material);
  }
  /// A lamp on a two-sided surface shines to both sides of it.
  [[gnu::always_inline]] bool lampOn(const Hit& hit) const {
    return from_ == kNone && RayCaster::startsOn(hit, origin_) && scene_.surfaces().doubleSided(hit.material);
  }
  bool escape() {
    ledger_.escaped += fixed_;
    return false;
  }

  [[gnu::always_inline]] bool scatter(const Hit& hit, const std::array<std::uint32_t, 4>& words, Vec3f wi, Vec3f n,
                                      Vec3f ns) {
    Bsdf scratch;
    const Bsdf& bsdf = scene_.surfaces().bsdf(hit.material, hit.triangle, hit.b, scratch);
    const Frame<float> frame(ns);
    return bsdf.lambert() ? scatterDiffuse(bsdf, frame, words, wi, n) : scatterCoated(hit, bsdf, frame, words, wi, n);
  }

  /// Of a diffuse surface every way on weighs its albedo, and none is lost.
  [[gnu::always_inline]] bool scatterDiffuse(const Bsdf& bsdf, const Frame<float>& frame,
                                             const std::array<std::uint32_t, 4>& words, Vec3f wi, Vec3f n) {
    const Rgb onward = beta_ * bsdf.diffuse;
    const FixedRgb fixedOnward(onward);
    path_.absorbed += fixed_ - fixedOnward;
    // Unit but for the rounding of this one hit: nothing of it is handed on from bounce to bounce.
    direction_ = frame.toWorld(sampleLambert({toUnitFloat(words[1]), toUnitFloat(words[2])}));
    return goOn(onward, fixedOnward, toUnitFloat(words[3]), wi, n, frame.n);
  }

  bool scatterCoated(const Hit& hit, const Bsdf& bsdf, const Frame<float>& frame,
                     const std::array<std::uint32_t, 4>& words, Vec3f wi, Vec3f n) {
    const Vec3f wiLocal = frame.toLocal(wi), u{toUnitFloat(words[0]), toUnitFloat(words[1]), toUnitFloat(words[2])};
    const Coat* coat = scene_.surfaces().coat(hit.material);
    const SampleWithAlbedo s =
        coat != nullptr ? sampleCoated(bsdf, *coat, wiLocal, u) : sampleWithAlbedo(bsdf, wiLocal, u);
    const Rgb onward = s.sample ? sane(beta_ * s.sample->weight) : Rgb{};
    const FixedRgb fixedOnward(onward);
    path_.absorbed += fixed_ - fixedOnward;
    path_.error += FixedRgb(sane(beta_ * s.albedo)) - fixedOnward;
    if (!s.sample) return false;
    direction_ = normalize(frame.toWorld(s.sample->wo));
    return goOn(onward, fixedOnward, toUnitFloat(words[3]), wi, n, frame.n);
  }

  [[gnu::always_inline]] bool goOn(Rgb onward, const FixedRgb& fixedOnward, float u, Vec3f wi, Vec3f n, Vec3f ns) {
    if (ns == n) return roulette(onward, fixedOnward, u);
    const Rgb corrected = onward * shadingCorrection(wi, direction_, n, ns);
    const FixedRgb fixedCorrected(corrected);
    path_.shadingNormal += fixedOnward - fixedCorrected;
    return roulette(corrected, fixedCorrected, u);
  }

  /// Interpolated normals make the BSDF non-symmetric; light carries the adjoint one, f · |wi·ns||wo·n| /
  /// (|wi·n||wo·ns|) (Veach 1997, equation 5.19), and none goes through the surface.
  float shadingCorrection(Vec3f wi, Vec3f wo, Vec3f n, Vec3f ns) {
    const float woN = dot(wo, n);
    if (woN <= 0) return 0;
    const float factor = shadingReception(wi, n, ns) * woN / std::max(std::abs(dot(wo, ns)), 1e-6f);
    if (factor <= kLargestShadingCorrection) return factor;
    ++ledger_.clampedNormals;
    return kLargestShadingCorrection;
  }

  /// Survival in proportion to what is left of the photon, so that beta stays nearly constant.
  [[gnu::always_inline]] bool roulette(Rgb onward, const FixedRgb& fixedOnward, float u) {
    const float left = maxComponent(onward);
    if (!(u * reference_ < left)) {  // p = min(1, left / reference)
      path_.roulette += fixedOnward;
      return false;
    }
    setBeta(sane(onward * std::max(1.f, reference_ / left)));
    path_.roulette += fixedOnward - fixed_;
    return true;
  }

  [[gnu::always_inline]] void setBeta(Rgb beta) {
    beta_ = beta;
    fixed_ = FixedRgb(beta);
  }

  /// Numbers that no arithmetic should give are counted and dropped, never passed on.
  [[gnu::always_inline]] Rgb sane(Rgb beta) {
    constexpr float kLargest = 0x1p24f;  // far above what roulette lets grow; keeps a path's sums in 64 bits
    if (minComponent(beta) >= 0 && beta.x + beta.y + beta.z <= kLargest) return beta;  // NaN fails the second
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
