// What a report tells beside the tracing: lights, warnings, the machine, and the command that bakes the same again.
#pragma once

#include <nlohmann/json.hpp>

#include "app/check_input.h"
#include "distributed/part_header.h"
#include "dlm/light_maps.h"

namespace lucarne {

// None of it is kept with the light maps, whose bytes are the same for every machine and name.

/// Adds lights and warnings. `skyMissing`: the scene of the input lacks the sky that the bake had, so nothing is said
/// of lights. `maps` may be null.
void addSceneToReport(const CheckInput& input, bool skyMissing, const LightMaps* maps, nlohmann::json& report);

/// Adds host, builds, command and rate_curve (empty where it is not known).
void addMakersToReport(const BakeOptions& options, const PartHeader& header, nlohmann::json& report);

/// Charts whose texels got few photons, as a warning.
void warnOfFewPhotons(const Scene& scene, const BakePlan& plan, const LightMaps& maps, CheckWarnings& warnings);

}  // namespace lucarne
