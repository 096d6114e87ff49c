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
    while (range.begin < range.end) {
      const std::uint64_t left = 0xffffffffu - (range.begin & 0xffffffffu);  // of the block, behind the first
      const std::uint64_t end = range.begin + (left < range.size() - 1 ? left + 1 : range.size());
      const PhotonNumberSeeds seeds(seed, range.begin >> 32);
      PathLedger sums;
      for (; range.begin < end; ++range.begin)
        PhotonPath<features, Sink>(scene, {seeds, range.begin}, limits, sink, ledger, sums).trace();
      sums.addTo(ledger);
    }
  });
}
template <class Sink>
void tracePhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, Sink& sink,
                  Ledger& ledger) {
  tracePhotons(scene, range, seed, limits, sink, ledger, photonVariantFor(scene.surfaces().features()));
}

}  // namespace lucarne
