// A fingerprint of how this program on this processor traces a scene.
#pragma once

#include "base/hash.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

/// Hash over 4096 segments of photons of a fixed seed: what they met, where, and with how much flux. Machines on which
/// it is equal give the same photons (as far as 4096 segments tell); it takes milliseconds.
Hash128 probeRays(const PhotonScene& scene);

}  // namespace lucarne
