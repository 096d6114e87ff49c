// The photon tracer. Photon i is a pure function of (scene, seed, i); what it does at its hits is the sink's business.
//
// A sink has `void hit(const PhotonHit&)`, called at every hit on a lit side (front, or back of a two-sided
// material), and `void endPhoton()`, called once after each photon.
#pragma once

#include "tracer/transport/photon_path.h"
#include "tracer/transport/photon_variants.h"

namespace lucarne {

/// Traces the photons of `range` with the variant of the loop that the scene asks for, or with variant `variant`, which
/// must do what the scene needs: all that do give the same photons. Nothing happens when the scene emits no light.
template <class Sink>
void tracePhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, Sink& sink,
                  Ledger& ledger, std::size_t variant) {
  if (scene.emitters().empty()) return;
  withPhotonVariant(variant, [&]<SceneFeatures features>() {
    for (std::uint64_t i = range.begin; i < range.end; ++i) {
      const PhotonSampler sampler(seed, i);
      PhotonPath<features, Sink>(scene, sampler, limits, sink, ledger).trace();
    }
  });
}
template <class Sink>
void tracePhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, Sink& sink,
                  Ledger& ledger) {
  tracePhotons(scene, range, seed, limits, sink, ledger, photonVariantFor(scene.surfaces().features()));
}

}  // namespace lucarne
