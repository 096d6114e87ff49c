// What a bake says of itself: the report, and the part of it that the .dlm keeps.
#pragma once

#include <nlohmann/json.hpp>

#include "app/bake_scene.h"

namespace lucarne {

/// The report's keys are a contract with others; see docs/report.md.
nlohmann::json makeReport(const BakeOptions& options, const PhotonScene& scene, const BakePlan& plan, const Baked& baked);

/// Nothing that differs from run to run of the same bake.
nlohmann::json provenanceOf(nlohmann::json report);

/// The file's name, or that of the built-in scene.
std::string sceneName(const BakeOptions& options);

}  // namespace lucarne
