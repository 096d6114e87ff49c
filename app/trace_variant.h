// Which variant of the tracing loop a scene runs in, and what that saves.
#pragma once

#include <nlohmann/json.hpp>

#include "tracer/transport/photon_scene.h"

namespace lucarne {

/// The name of the variant, and what it leaves out.
nlohmann::json traceVariant(const Scene& scene);

/// Rays per CPU second of the scene's variant over those of the general one: a few thousand photons through both, turn
/// and turn about, nothing stored; 1 where the scene needs the general one or gives no light. The two must trace the
/// same rays, which is checked.
double traceVariantSpeedup(const PhotonScene& scene);

}  // namespace lucarne
