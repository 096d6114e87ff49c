#include "dlm/dlm_reader_pages.h"

#include <algorithm>

#include "dlm/layer_file.h"

namespace lucarne {

namespace {

// Calls use(index in the rectangle, index in the page) row by row.
template <class Use>
void forEachTexel(int x, int y, int width, int height, int pageWidth, Use use) {
  std::size_t texel = 0;
  for (int row = 0; row < height; ++row) {
    std::size_t pixel =
        static_cast<std::size_t>(y + row) * static_cast<std::size_t>(pageWidth) + static_cast<std::size_t>(x);
    for (int column = 0; column < width; ++column) use(texel++, pixel++);
  }
}

void readIrradianceSides(const LayerFile& file, bool back, LightMaps& maps) {
  const std::string name = back ? "back" : "front";
  const int width = std::max(1, maps.atlasWidth), height = std::max(1, maps.atlasHeight);
  const ExrLayer& statistics = file.layer(name + dlm_file::kStatistics, width, height);
  const auto rgb = file.rgb(file.layer(name, width, height));
  const std::vector<float>& photons = file.values(statistics, "photons");
  const std::vector<float>& relativeError = file.values(statistics, "relative_error");
  // Files of before it was written have the relative one alone.
  const std::vector<float>* standardError =
      statistics.find("standard_error") == nullptr ? nullptr : &file.values(statistics, "standard_error");
  for (const SideMaps& side : maps.sides) {
    if (!side.lit || side.back != back) continue;
    const MapChart& chart = maps.charts[side.chart];
    forEachTexel(chart.atlasX, chart.atlasY, side.width, side.height, width, [&](std::size_t texel, std::size_t pixel) {
      const std::size_t i = side.firstTexel + texel;
      maps.irradiance[i] = {(*rgb[0])[pixel], (*rgb[1])[pixel], (*rgb[2])[pixel]};
      maps.photons[i] = photons[pixel];
      maps.relativeError[i] = relativeError[pixel];
      maps.standardError[i] =
          standardError != nullptr ? (*standardError)[pixel] : relativeError[pixel] * luminance(maps.irradiance[i]);
    });
  }
}

}  // namespace

void readIrradiance(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps) {
  const LayerFile file(path, readExr(path));
  // Only now, with the layers seen, is the number of texels to be believed.
  const int width = std::max(1, maps.atlasWidth), height = std::max(1, maps.atlasHeight);
  for (const std::string& name : contents.pages.irradianceLayers) file.layer(name, width, height);
  file.layer("front", width, height);
  maps.irradiance.resize(contents.texelCount);
  maps.photons.resize(contents.texelCount);
  maps.relativeError.resize(contents.texelCount);
  maps.standardError.resize(contents.texelCount);
  readIrradianceSides(file, false, maps);
  if (hasLitBack(maps)) readIrradianceSides(file, true, maps);
}

}  // namespace lucarne
