#include "tracer/transport/any_sink.h"

#include "tracer/transport/photon_tracer.h"

namespace lucarne {

void flyPhotons(const PhotonScene& scene, IndexRange range, const PhotonSeed& seed, const TraceLimits& limits, AnySink& sink,
                Ledger& ledger, std::size_t variant) {
  tracePhotons(scene, range, seed, limits, sink, ledger, variant);
}

}  // namespace lucarne
