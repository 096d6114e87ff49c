// The bake: scene in, light maps out.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/bake_options.h"
#include "app/report_pictures.h"
#include "distributed/job_control.h"

namespace lucarne {

/// Bakes and writes the .dlm or the part (and the report where asked). Returns the report. Throws Error; leaves nothing
/// half-written. Error(interrupted) when `control` stopped it: its line says where the state is. Started by an MPI
/// launcher, all ranks bake together, and all but rank 0 return null. `player` draws the pictures of the report's page
/// where it can.
nlohmann::json bake(const BakeOptions& options, const JobControl& control = {}, const PlayerPictures& player = {});

}  // namespace lucarne
