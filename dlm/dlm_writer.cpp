#include "dlm/dlm_writer.h"

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "dlm/dlm_writer_pages.h"
#include "dlm/manifest.h"
#include "dlm/manifest_seal.h"

namespace lucarne {

namespace {

// Broken maps are found here, where the stack still says who made them, and not by the next reader.
void checkMaps(const LightMaps& maps) {
  LUCARNE_CHECK_EQ(std::all_of(maps.irradiance.begin(), maps.irradiance.end(), isFinite<float>), true);
  LUCARNE_CHECK_EQ(std::all_of(maps.directional.begin(), maps.directional.end(), isFinite<float>), true);
  LUCARNE_CHECK_EQ(std::all_of(maps.meanDirections.begin(), maps.meanDirections.end(), isFinite<float>), true);
  if (maps.hasMeans()) LUCARNE_CHECK_EQ(maps.meanDirections.size(), maps.directional.size());
  LUCARNE_CHECK_EQ(maps.irradiance.size(), maps.relativeError.size());
  LUCARNE_CHECK_EQ(maps.irradiance.size(), maps.standardError.size());
  LUCARNE_CHECK_EQ(maps.irradiance.size(), maps.photons.size());
  for (std::size_t i = 0; i < maps.sides.size(); ++i) {
    const SideMaps& side = maps.sides[i];
    LUCARNE_CHECK_LT(side.chart, maps.charts.size());
    const MapChart& chart = maps.charts[side.chart];
    LUCARNE_CHECK_EQ(side.back ? chart.backSide : chart.frontSide, i);
    LUCARNE_CHECK_EQ(side.width, chart.width);
    LUCARNE_CHECK_EQ(side.height, chart.height);
    if (side.lit) LUCARNE_CHECK_LE(side.firstTexel + side.texelCount(), maps.irradiance.size());
    for (const SideDirection& direction : side.directions) {
      LUCARNE_CHECK_LT(static_cast<int>(direction.psi), maps.directionCount);
      if (direction.stored()) LUCARNE_CHECK_LE(direction.first + side.texelCount(), maps.directional.size());
    }
  }
  for (const MapChart& chart : maps.charts) {
    LUCARNE_CHECK_LE(0, std::min(chart.atlasX, chart.atlasY));
    LUCARNE_CHECK_LE(chart.atlasX + chart.width, maps.atlasWidth);
    LUCARNE_CHECK_LE(chart.atlasY + chart.height, maps.atlasHeight);
  }
}

std::vector<std::string> namesOf(const std::vector<ExrLayer>& layers) {
  std::vector<std::string> names;
  for (const ExrLayer& layer : layers) names.push_back(layer.name);
  return names;
}

// Each file's layers are gone from memory before the next are made.
PageLayout writeImages(const std::filesystem::path& folder, const LightMaps& maps, const DlmFormat& format) {
  PageLayout pages;
  {
    const std::vector<ExrLayer> layers = irradianceLayers(maps);
    writeExr(folder / dlm_file::kIrradiance, layers, format.compression);
    pages.irradianceLayers = namesOf(layers);
  }
  pages.directional = packDirectional(maps, format.directional != MapFormat::ldr8);
  pages.directional.format = format.directional;
  const bool bounded = format.directional == MapFormat::half || format.directional == MapFormat::rgb9e5;
  if (bounded) pages.directional.scale = directionalScale(maps);
  if (format.directional == MapFormat::ldr8) pages.directional.mapScales = ldrScales(maps, format.kMax).scales;
  if (!pages.directional.layers.empty())
    writeExr(folder / dlm_file::kDirectional, directionalLayers(maps, pages.directional), format.compression);
  pages.directional.means = maps.hasMeans() && !pages.directional.layers.empty();
  if (pages.directional.means)
    writeExr(folder / dlm_file::kMoments, meanLayers(maps, pages.directional), format.compression);
  return pages;
}

}  // namespace

void writeDlm(const std::filesystem::path& folder, const Scene& scene, const AtlasUv& uv, const LightMaps& maps,
              const nlohmann::json& provenance, const DlmFormat& format) {
  LUCARNE_CHECK_EQ(provenance.is_object(), true);
  checkMaps(maps);
  writeFolderAtomically(folder, holdsLightMaps, [&](const std::filesystem::path& aside) {
    writeFileAtomically(aside / dlm_file::kScene, writeSceneGlb(scene, uv));
    const PageLayout pages = writeImages(aside, maps, format);
    std::vector<std::string> files = {dlm_file::kScene, dlm_file::kIrradiance};
    if (!pages.directional.layers.empty()) files.emplace_back(dlm_file::kDirectional);
    if (pages.directional.means) files.emplace_back(dlm_file::kMoments);
    nlohmann::json manifest = provenance;
    manifest.update(describeMaps(maps, scene.frame, pages));
    manifest["files"] = sealFiles(aside, files);
    // Names of files in the provenance need not be UTF-8.
    const std::string text = manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    writeFileAtomically(aside / dlm_file::kManifest, text + "\n");
  });
}

bool holdsLightMaps(const std::filesystem::path& folder) {
  try {
    const std::vector<std::uint8_t> bytes = readFile(folder / dlm_file::kManifest);
    const nlohmann::json manifest = nlohmann::json::parse(bytes.begin(), bytes.end());
    const auto format = manifest.find("format");
    return format != manifest.end() && *format == dlm_file::kFormat;
  } catch (const std::exception&) {
    return false;  // missing, unreadable or not JSON: not ours
  }
}

}  // namespace lucarne
