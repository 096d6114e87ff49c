// Reads a .dlm folder (docs/dlm-format.md).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "dlm/light_maps.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct Dlm {
  Scene scene;  // with chartOfTriangle; atlasUv is the place in the irradiance atlas
  LightMaps maps;
  nlohmann::json manifest;  // everything that stands in it, provenance included
};

/// Everything is checked: the files' lengths and hashes, sizes, indices, rectangles, missing layers, numbers that are
/// not finite, the charts of the triangles. InputError names the file and what is wrong with it. In LightMaps the
/// sides' texels follow each other in the order of the sides, and each side's stored directions likewise.
Dlm readDlm(const std::filesystem::path& folder);

/// The manifest alone, parsed and recognised as ours.
nlohmann::json readManifest(const std::filesystem::path& folder);

}  // namespace lucarne
