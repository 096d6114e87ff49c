// Going on with what an earlier run of the same bake left.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "app/bake_options.h"
#include "distributed/bake_job.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The report of an earlier run whose output is just what these options ask for; nothing unless --resume was given.
/// `header`: of this bake, nothing traced yet.
std::optional<nlohmann::json> finishedBefore(const BakeOptions& options, const PartHeader& header);

/// Opens the folder of states. With --resume, the newest state there (or the finished part) becomes `state`;
/// Error(mergeRefused) names what differs when it is of another bake, of another `scene` what light would notice.
/// Without, states that are there are moved aside, with a warning; but a finished part of this very bake, with all of
/// its photons, becomes `state`: tracing would only give it once more.
void takeUp(const BakeOptions& options, const Scene& scene, CheckpointFolder& folder, BakeState& state);

}  // namespace lucarne
