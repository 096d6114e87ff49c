// The photon tracer for sinks that need not be fast. tracePhotons() compiles all its variants for each type of sink:
// flyPhotons() does so once, and calls the sink through a virtual function, which costs some nanoseconds a hit.
#pragma once

#include "tracer/optics/sampler.h"
#include "tracer/transport/ledger.h"
#include "tracer/transport/photon_hit.h"
#include "tracer/transport/photon_scene.h"
#include "tracer/transport/photon_variants.h"

namespace lucarne {

class AnySink {
 public:
  virtual ~AnySink() = default;
  virtual void hit(const PhotonHit& hit) = 0;
  virtual void endPhoton() = 0;
};

/// Forwards to a sink of another type, which must outlive this.
template <class Sink>
class AnySinkTo final : public AnySink {
 public:
  explicit AnySinkTo(Sink& sink) : sink_(sink) {}
  void hit(const PhotonHit& hit) override { sink_.hit(hit); }
  void endPhoton() override { sink_.endPhoton(); }

 private:
  Sink& sink_;
};

void flyPhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, AnySink& sink,
                Ledger& ledger, std::size_t variant);

/// See tracePhotons(): the same photons to the last bit.
template <class Sink>
void flyPhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, Sink& sink,
                Ledger& ledger, std::size_t variant) {
  AnySinkTo<Sink> any(sink);
  flyPhotons(scene, range, seed, limits, static_cast<AnySink&>(any), ledger, variant);
}
template <class Sink>
void flyPhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, Sink& sink,
                Ledger& ledger) {
  flyPhotons(scene, range, seed, limits, sink, ledger, photonVariantFor(scene.surfaces().features()));
}

}  // namespace lucarne
