// Settings as parts and reports carry them, and back.
#pragma once

#include <nlohmann/json.hpp>

#include "app/bake_plan.h"
#include "base/json.h"
#include "distributed/part_header.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

/// All that photons and tallies depend on besides the scene. Of gathered direct light only where it is gathered.
nlohmann::json traceSettings(const BakeOptions& options);
/// How maps are made of tallies.
nlohmann::json resolveSettings(const BakeOptions& options);
/// "fit" or "keep".
std::string seamsName(const BakeOptions& options);

/// Of which bake it is, and who makes it here.
BakeIdentity identityOf(const BakeOptions& options, const PhotonScene& scene, const BakePlan& plan);
Maker makerOf(const PhotonScene& scene);

/// The options of a bake whose header this is; everything else as by default. Error(mergeRefused), naming `file`, for
/// settings that this program does not know.
BakeOptions optionsOf(const PartHeader& header, const std::string& file);

/// Of charts, texels, directions and the order of tallies.
Hash128 layoutHash(const BakePlan& plan);

}  // namespace lucarne
