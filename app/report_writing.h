// Writing a report: the JSON, and the page beside it.
#pragma once

#include <nlohmann/json.hpp>

#include "app/bake_plan.h"
#include "app/report_files.h"
#include "app/report_pictures.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

/// What a report tells of beside the tracing.
struct ReportContext {
  const BakeOptions& options;
  const PhotonScene& scene;
  const BakePlan& plan;
  const PlayerPictures& player;
  bool skyMissing = false;  // the bake had a sky that `scene` has not
};

/// Asked before the work: Error(failed) where the report or its page cannot be written.
void checkReport(const std::filesystem::path& report);

/// Adds what addSceneToReport() and addMakersToReport() add and writes the report where the options say so; returns it.
/// The page is made of the light maps as they stand on disk; of a part, of `maps`, which else may be null. What keeps
/// pictures from being made is a note on the page, no error.
nlohmann::json writeReport(const ReportContext& context, const PartHeader& header, const LightMaps* maps,
                           nlohmann::json report);

}  // namespace lucarne
