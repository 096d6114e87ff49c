// One photon's flight, from its emission to its end. Compiled for the features that the scene has.
#pragma once

#include <cstdint>

#include "tracer/optics/coat.h"
#include "tracer/optics/photon_numbers.h"
#include "tracer/optics/scattering.h"
#include "tracer/transport/meet.h"
#include "tracer/transport/path_ledger.h"
#include "tracer/transport/photon_hit.h"
#include "tracer/transport/photon_scene.h"
#include "tracer/transport/shading_normal.h"

namespace lucarne {

template <SceneFeatures features, class Sink>
class PhotonPath {
 public:
  /// `sums` goes into the ledger when the caller wants it.
  PhotonPath(const PhotonScene& scene, const PhotonNumbers& numbers, const TraceLimits& limits, Sink& sink,
             Ledger& ledger, PathLedger& sums)
      : scene_(scene),
        surfaces_(scene.surfaces()),
        numbers_(numbers),
        limits_(limits),
        sink_(sink),
        ledger_(ledger),
        sums_(sums) {}

  [[gnu::always_inline]] void trace() { trace(scene_.emitters().sample(numbers_.emission())); }
  [[gnu::always_inline]] void trace(const EmittedPhoton& photon) {
    emit(photon);
    std::uint32_t event = 1;
    for (; step(event); ++event) {
      if (event >= limits_.depth) {
        ledger_.cutOff += fixed_;
        ++ledger_.cutOffPaths;
        break;
      }
    }
    ledger_.rays += event;
    sums_.endPhoton(ledger_);
    sink_.endPhoton();
  }

 private:
  using Words = PhotonNumbers::Words;

  [[gnu::always_inline]] void emit(const EmittedPhoton& photon) {
    setBeta(sane(photon.beta));
    sums_.emitted += fixed_;
    reference_ = maxComponent(beta_);
    from_ = photon.triangle;
    origin_ = from_ == kNone ? Vec3f(photon.position)
                             : RayCaster::leave(photon.position, photon.normal, scene_.rayCaster().clearance(from_));
    direction_ = photon.direction;
  }

  /// One segment and what happens at its end. False when the path is over.
  [[gnu::always_inline]] bool step(std::uint32_t event) {
    Hit hit;
    Words words;
    if (!meet(hit, event, words)) {
      sums_.escaped += fixed_;
      return false;
    }
    ++ledger_.hits;
    if constexpr (features.transmission) attenuate(hit);
    if (isBlackBack(scene_, hit)) [[unlikely]] {
      sums_.absorbed += fixed_;
      return false;
    }
    const Vec3f wi = -direction_, n = hit.back ? -hit.n : hit.n;
    const Vec3f ns = scene_.shadingNormal(hit, n);
    flat_ = !features.normalMaps && !hit.smooth;
    sink_.hit(PhotonHit{hit, event, numbers_.odd(), words, beta_, wi, n, ns});
    if (!scatter(hit, words, wi, n, ns)) return false;
    from_ = hit.triangle;
    origin_ = RayCaster::leave(hit.position, features.transmission && dot(direction_, n) < 0 ? -n : n, hit.clearance);
    return true;
  }

  /// Draws the numbers of the event, too: while the memory comes that the hit needs.
  [[gnu::always_inline]] bool meet(Hit& hit, std::uint32_t event, Words& words) {
    return meetSurface<features.holes>(
        scene_, {origin_, direction_, from_}, ledger_.repeatedRays,
        [&](std::uint32_t triangle) {
          if constexpr (requires { sink_.prefetch(triangle); }) sink_.prefetch(triangle);
          words = numbers_.scatter(event);
        },
        [&](const Hit& h) { return goesThroughByChance(surfaces_, h, numbers_.sampler(), event); },
        hit);
  }

  /// What the volume takes that this segment went through. A back says by itself that the light was inside.
  void attenuate(const Hit& hit) {
    const std::uint32_t medium = hit.back && surfaces_.solid(hit.material) ? hit.material : medium_;
    if (medium == kNone || surfaces_.attenuation(medium).clear()) return;
    const double metres = length(hit.position - Vec3d(origin_)) * scene_.scene().frame.scale;
    const FixedRgb before = fixed_;
    setBeta(beta_ * surfaces_.attenuation(medium).over(metres));
    sums_.absorbed += before - fixed_;
  }

  [[gnu::always_inline]] bool scatter(const Hit& hit, const Words& words, Vec3f wi, Vec3f n, Vec3f ns) {
    if constexpr (features.normalMaps) ns = scene_.mappedNormal(hit, n, ns);
    const Frame<float> frame(ns);
    if constexpr (features.transmission) {
      if (surfaces_.transmits(hit.material)) return scatterGlass(hit, frame, words, wi, n);
    }
    if constexpr (!features.coats) {
      return scatterDiffuse(surfaces_.constantBsdf(hit.material), frame, words, wi, n);
    } else {
      Bsdf scratch;
      const Bsdf& bsdf =
          features.textures ? surfaces_.bsdf(placeOf(hit), scratch) : surfaces_.constantBsdf(hit.material);
      return bsdf.lambert() ? scatterDiffuse(bsdf, frame, words, wi, n) : scatterCoated(hit, bsdf, frame, words, wi, n);
    }
  }

  /// Of a diffuse surface every way on weighs its albedo, and none is lost.
  [[gnu::always_inline]] bool scatterDiffuse(const Bsdf& bsdf, const Frame<float>& frame, const Words& words, Vec3f wi,
                                             Vec3f n) {
    const Rgb onward = beta_ * bsdf.diffuse;
    const FixedRgb fixedOnward(onward);
    sums_.absorbed += fixed_ - fixedOnward;
    // Unit but for the rounding of this one hit: nothing of it is handed on from bounce to bounce.
    direction_ = frame.toWorld(sampleLambert({toUnitFloat(words[1]), toUnitFloat(words[2])}));
    return goOn(onward, fixedOnward, toUnitFloat(words[3]), wi, n, frame.n);
  }

  bool scatterCoated(const Hit& hit, const Bsdf& bsdf, const Frame<float>& frame, const Words& words, Vec3f wi,
                     Vec3f n) {
    const Vec3f wiLocal = frame.toLocal(wi);
    const Coat* coat = surfaces_.coat(hit.material);
    const SampleWithAlbedo s = coat != nullptr ? sampleCoated(bsdf, *coat, wiLocal, lobeNumbers(words))
                                               : sampleWithAlbedo(bsdf, wiLocal, lobeNumbers(words));
    return follow(s.sample, s.albedo, frame, words, wi, n);
  }

  bool scatterGlass(const Hit& hit, const Frame<float>& frame, const Words& words, Vec3f wi, Vec3f n) {
    const Scattering scattering = scatteringAt(surfaces_, placeOf(hit), hit.back);
    const Vec3f wiLocal = frame.toLocal(wi);
    const auto s = sample(scattering, wiLocal, lobeNumbers(words), Transport::flux);
    if (s && s->wo.z < 0 && surfaces_.solid(hit.material)) medium_ = hit.back ? kNone : hit.material;
    return follow(s, albedo(scattering, wiLocal), frame, words, wi, n);
  }

  static Vec3f lobeNumbers(const Words& words) {
    return {toUnitFloat(words[0]), toUnitFloat(words[1]), toUnitFloat(words[2])};
  }

  bool follow(const std::optional<BsdfSample>& s, Rgb meanWeight, const Frame<float>& frame, const Words& words,
              Vec3f wi, Vec3f n) {
    const Rgb onward = s ? sane(beta_ * s->weight) : Rgb{};
    const FixedRgb fixedOnward(onward);
    sums_.absorbed += fixed_ - fixedOnward;
    sums_.error += FixedRgb(sane(beta_ * meanWeight)) - fixedOnward;
    if (!s) return false;
    direction_ = normalize(frame.toWorld(s->wo));
    return goOn(onward, fixedOnward, toUnitFloat(words[3]), wi, n, frame.n);
  }

  [[gnu::always_inline]] bool goOn(Rgb onward, const FixedRgb& fixedOnward, float u, Vec3f wi, Vec3f n, Vec3f ns) {
    if (flat_ || ns == n) return roulette(onward, fixedOnward, u);
    float correction = adjointCorrection(wi, direction_, n, ns);
    if (correction > kLargestShadingCorrection) {
      correction = kLargestShadingCorrection;
      ++ledger_.clampedNormals;
    }
    const Rgb corrected = onward * correction;
    const FixedRgb fixedCorrected(corrected);
    sums_.shadingNormal += fixedOnward - fixedCorrected;
    return roulette(corrected, fixedCorrected, u);
  }

  /// maxComponent() without a branch, which could not be foretold.
  static float largest(Rgb v) {
    const float yz = v.y < v.z ? v.z : v.y;
    return v.x < yz ? yz : v.x;
  }

  /// Survival in proportion to what is left of the photon, so that beta stays nearly constant.
  [[gnu::always_inline]] bool roulette(Rgb onward, const FixedRgb& fixedOnward, float u) {
    const float left = largest(onward);
    if (!(u * reference_ < left)) {  // p = min(1, left / reference)
      sums_.roulette += fixedOnward;
      return false;
    }
    setBeta(sane(onward * std::max(1.f, reference_ / left)));
    sums_.roulette += fixedOnward - fixed_;
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
  const SurfaceTable& surfaces_;
  const PhotonNumbers numbers_;
  const TraceLimits& limits_;
  Sink& sink_;
  Ledger& ledger_;
  PathLedger& sums_;
  Rgb beta_{};
  FixedRgb fixed_;  // beta_ in fixed point
  float reference_ = 1;
  Vec3f origin_{}, direction_{};
  std::uint32_t from_ = kNone;
  std::uint32_t medium_ = kNone;  // material of the volume that the photon is in
  bool flat_ = false;             // where it is, the shading normal is known to be the geometric one
};

}  // namespace lucarne
