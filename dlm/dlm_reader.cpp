#include "dlm/dlm_reader.h"

#include "base/error.h"
#include "base/files.h"
#include "dlm/dlm_reader_pages.h"
#include "dlm/dlm_reader_steps.h"
#include "dlm/manifest.h"
#include "dlm/manifest_seal.h"
#include "tracer/scene/gltf_json.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {

namespace {

constexpr std::uint64_t kLargestManifest = std::uint64_t{1} << 29;

constexpr double kRounding = 0.05;  // texels: of float texture coordinates in a large atlas

bool inside(const MapChart& chart, const LightMaps& maps, Vec2f uv) {
  const double s = static_cast<double>(uv.x) * maps.atlasWidth - chart.atlasX;
  const double t = static_cast<double>(uv.y) * maps.atlasHeight - chart.atlasY;
  return s >= -kRounding && t >= -kRounding && s <= chart.width + kRounding && t <= chart.height + kRounding;
}

void checkTriangle(const Scene& scene, const LightMaps& maps, std::uint32_t triangle, const std::string& file) {
  const auto fail = [&](const std::string& what) {
    throw InputError(file + ": triangle " + std::to_string(triangle) + " " + what + "; the files are not of one bake");
  };
  const std::uint32_t chart = scene.chartOfTriangle[triangle];
  if (chart == kNone) return;
  if (chart >= maps.charts.size()) {
    fail("belongs to chart " + std::to_string(chart) + " of " + std::to_string(maps.charts.size()));
  }
  if (scene.triangles[triangle].material != maps.charts[chart].material) fail("is not of its chart's material");
  for (const std::uint32_t v : scene.triangles[triangle].v) {
    if (!inside(maps.charts[chart], maps, scene.atlasUv[v])) fail("lies outside the rectangle of its chart");
  }
}

void checkCharts(const Scene& scene, const LightMaps& maps, const std::string& file) {
  if (scene.chartOfTriangle.size() != scene.triangles.size() ||
      (scene.atlasUv.size() != scene.positions.size() && !maps.charts.empty())) {
    throw InputError(file + ": does not say which chart each triangle belongs to; bake the scene again");
  }
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) checkTriangle(scene, maps, i, file);
}

constexpr double kChecking = 0.15;  // of the time that all takes: the hashes of the files

/// Which share of the rest is done before the irradiance, and before the directional maps: by the files' bytes.
struct Shares {
  double irradiance = 0, directional = 0;
  explicit Shares(const std::filesystem::path& folder) {
    const auto bytes = [&](const char* name) {
      std::error_code none;
      const auto size = std::filesystem::file_size(folder / name, none);
      return none ? 1.0 : static_cast<double>(size) + 1;
    };
    const double a = bytes(dlm_file::kScene), b = bytes(dlm_file::kIrradiance), c = bytes(dlm_file::kDirectional);
    irradiance = kChecking + (1 - kChecking) * a / (a + b + c);
    directional = kChecking + (1 - kChecking) * (a + b) / (a + b + c);
  }
};

}  // namespace

nlohmann::json readManifest(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(folder.string() + ": is not a folder of light maps; give the NAME.dlm that a bake wrote");
  }
  const std::filesystem::path path = folder / dlm_file::kManifest;
  const std::vector<std::uint8_t> bytes = readFile(path, kLargestManifest);
  const std::string text(bytes.begin(), bytes.end());
  nlohmann::json manifest = parseGltfJson(text, Place(path.string()));
  if (textOf(manifest, "format", "", Place(path.string())) != dlm_file::kFormat) {
    throw InputError(path.string() + ": is not the manifest of light maps");
  }
  return manifest;
}

Dlm readDlm(const std::filesystem::path& folder) {
  return readDlm(folder, [](const std::string&, double) {});
}

OpenedDlm openDlm(const std::filesystem::path& folder, const DlmStep& observe) {
  OpenedDlm opened;
  Dlm& dlm = opened.dlm;
  dlm.manifest = readManifest(folder);
  const Shares shares(folder);
  observe("checking the files", 0);
  ManifestContents contents = readManifestMaps(dlm.manifest, (folder / dlm_file::kManifest).string());
  const bool directional = !contents.pages.directional.layers.empty();
  for (const char* name : {dlm_file::kScene, dlm_file::kIrradiance}) checkSeal(dlm.manifest, folder, name);
  if (directional) checkSeal(dlm.manifest, folder, dlm_file::kDirectional);
  if (contents.pages.directional.means) checkSeal(dlm.manifest, folder, dlm_file::kMoments);
  observe("reading the scene", kChecking);
  const std::filesystem::path scenePath = folder / dlm_file::kScene;
  dlm.scene = readGltf(scenePath);
  observe("reading the irradiance", shares.irradiance);
  dlm.maps = std::move(contents.maps);
  readIrradiance(folder / dlm_file::kIrradiance, contents, dlm.maps);
  checkCharts(dlm.scene, dlm.maps, scenePath.string());
  opened.share = directional ? shares.directional : 1;
  if (directional)
    opened.directional.emplace(folder, dlm.maps, std::move(contents.pages.directional), contents.directionalCount);
  return opened;
}

Dlm readDlm(const std::filesystem::path& folder, const DlmStep& observe) {
  OpenedDlm opened = openDlm(folder, observe);
  observe("reading the directional maps", opened.share);
  if (opened.directional) readInto(*opened.directional, opened.dlm.maps);
  return std::move(opened.dlm);
}

}  // namespace lucarne
