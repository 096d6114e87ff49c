// Learning where light from far away is useful: a pilot of photons of their own, before the bake.
#pragma once

#include <cstdint>

#include "tracer/transport/photon_scene.h"

namespace lucarne {

struct GuidePilotOptions {
  std::uint64_t seed = 0;                          // of the bake
  std::uint64_t photons = std::uint64_t{1} << 17;  // to learn from, for each distant emitter; as many to judge
};

/// What the pilot of one distant emitter found.
struct GuidePilotResult {
  std::size_t emitter;
  double wasted;  // share of unguided photons that light no surface
  double gain;    // variance times cost of unguided photons over that of guided ones, as the pilot estimates it
  bool guided;    // only where the gain is worth it
};

/// Traces the pilots and gives the scene its guides. They depend on the scene and the options alone: pilot photons have
/// numbers that no photon of the bake has, and what they find is summed in integers.
std::vector<GuidePilotResult> learnGuides(PhotonScene& scene, const GuidePilotOptions& options);

}  // namespace lucarne
