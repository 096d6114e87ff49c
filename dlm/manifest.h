// The part of manifest.json that says how light maps lie in the pages of a .dlm folder (docs/dlm-format.md).
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dlm/light_maps.h"
#include "dlm/map_format.h"
#include "tracer/scene/scene.h"

namespace lucarne {

namespace dlm_file {
inline constexpr const char* kFormat = "lucarne-dlm";
inline constexpr int kVersion = 1;
inline constexpr const char* kManifest = "manifest.json";
inline constexpr const char* kScene = "scene.glb";
inline constexpr const char* kIrradiance = "irradiance.exr";
inline constexpr const char* kDirectional = "directional.exr";
inline constexpr const char* kMoments = "moments.exr";
inline constexpr const char* kMeanChannel = "MEAN";
inline constexpr const char* kStatistics = ".statistics";  // after "front" or "back"
}  // namespace dlm_file

/// Where the stored directional maps lie: all layers of directional.exr are pages of one size.
struct DirectionalPages {
  static constexpr std::int64_t kNotStored = -1;
  int width = 0, height = 0;
  std::vector<std::string> layers;
  // Of every member of every side, in order: x + width · (y + height · layer), or kNotStored.
  std::vector<std::int64_t> places;
  double scale = 1;  // lx = value in the file · scale, a power of two
  MapFormat format = MapFormat::half;
  std::vector<bool> neutral;  // by layer: one channel, Y, of maps without colour. A reader sees it by the channels
  std::vector<float> mapScales;  // of ldr8: of every stored map, in order; see texel_codes.h
  bool means = false;  // moments.exr has the mean directions, at the same places
};

struct PageLayout {
  std::vector<std::string> irradianceLayers;
  DirectionalPages directional;
};

/// What the manifest says of the maps. The vectors of texels are still empty: their sizes are to be believed only when
/// the image files turned out to be as large as the manifest says.
struct ManifestContents {
  LightMaps maps;
  PageLayout pages;
  std::uint64_t texelCount = 0;        // of irradiance, relativeError, photons
  std::uint64_t directionalCount = 0;  // of directional
};

/// The manifest's own keys; see docs/dlm-format.md.
nlohmann::json describeMaps(const LightMaps& maps, const LocalFrame& frame, const PageLayout& pages);

/// Of a manifest that nobody vouches for. Everything is checked that memory safety or meaning rests on: sizes, indices,
/// rectangles inside their pages and apart from each other. InputError names `file` and the place in it.
ManifestContents readManifestMaps(const nlohmann::json& manifest, const std::string& file);

/// Some back side is lit: the file then has layers of the back.
bool hasLitBack(const LightMaps& maps);

}  // namespace lucarne
