// The part of a bake that takes hours: direct light gathered and photons traced, with all that goes on meanwhile.
#pragma once

#include "app/bake_setup.h"
#include "distributed/bake_job.h"

namespace lucarne {

/// Gathers and traces what the state lacks. A scene without light is at once as good as traced, and so are photons that
/// would store nothing.
JobResult traceBake(const BakeSetup& setup, BakeState& state, CheckpointFolder& folder);

}  // namespace lucarne
