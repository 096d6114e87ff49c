#include "dlm/dlm_reader_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/exr_layers.h"
#include "base/huge_advice.h"
#include "base/image_file.h"
#include "dlm/direction_set_cells.h"
#include "dlm/mean_direction.h"
#include "dlm/texel_codes.h"

namespace lucarne {

namespace {

// The layers of one file, asked for by name.
class LayerFile {
 public:
  explicit LayerFile(const std::filesystem::path& path) : LayerFile(path, readExr(path)) {}
  LayerFile(const std::filesystem::path& path, std::vector<ExrLayer> layers)
      : name_(path.string()), layers_(std::move(layers)) {}

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  const ExrLayer& layer(const std::string& name, int width, int height) const {
    const auto found = std::find_if(layers_.begin(), layers_.end(), [&](const ExrLayer& l) { return l.name == name; });
    if (found == layers_.end()) fail("has no layer \"" + name + "\", which the manifest names");
    if (found->width != width || found->height != height) {
      fail("the layer \"" + name + "\" is " + sizeText(found->width, found->height) + ", not " +
           sizeText(width, height) + " as the manifest says");
    }
    return *found;
  }
  std::size_t indexOf(const ExrLayer& layer) const { return static_cast<std::size_t>(&layer - layers_.data()); }

  const std::vector<float>& values(const ExrLayer& layer, const char* channel) const {
    const ExrChannel* found = layer.find(channel);
    if (found == nullptr || found->type == ChannelType::uint32) {
      fail("the layer \"" + layer.name + "\" has no channel " + channel + " of real numbers");
    }
    if (!std::all_of(found->floats.begin(), found->floats.end(), [](float v) { return std::isfinite(v); })) {
      fail("the channel " + std::string(channel) + " of the layer \"" + layer.name +
           "\" holds a number that is not finite");
    }
    return found->floats;
  }

  std::array<const std::vector<float>*, 3> rgb(const ExrLayer& layer) const {
    return {&values(layer, "R"), &values(layer, "G"), &values(layer, "B")};
  }
  const std::vector<std::uint32_t>& codes(const ExrLayer& layer, const char* channel) const {
    const ExrChannel* found = layer.find(channel);
    if (found == nullptr || found->type != ChannelType::uint32)
      fail("the layer \"" + layer.name + "\" has no channel " + channel + " of whole numbers");
    return found->uints;
  }

 private:
  static std::string sizeText(int width, int height) { return std::to_string(width) + " × " + std::to_string(height); }

  std::string name_;
  std::vector<ExrLayer> layers_;
};

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

void readIrradiance(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps) {
  const LayerFile file(path);
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

void checkScale(const LayerFile& file, const ExrLayer& layer, double scale) {
  const auto attribute = layer.attributes.find("directional_scale");
  if (attribute == layer.attributes.end()) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", scale);
  if (attribute->second != text) {
    file.fail("the layer \"" + layer.name + "\" is scaled by " + attribute->second.substr(0, 40) + ", not by " + text +
              " as the manifest says");
  }
}

/// The texels of one page in lx.
class PageReader {
 public:
  PageReader(const LayerFile& file, const ExrLayer& layer, const DirectionalPages& pages)
      : format_(pages.format), scale_(pages.scale) {
    if (layer.channels.size() == 1 && layer.channels[0].name == "Y") {
      grey_ = &file.values(layer, "Y");
    } else if (isCoded(format_)) {
      codes_ = &file.codes(layer, codeChannel(format_));
    } else {
      rgb_ = file.rgb(layer);
    }
  }
  Rgb at(std::size_t pixel, float mapScale) const {
    if (grey_ != nullptr) return Rgb(static_cast<float>(static_cast<double>((*grey_)[pixel]) * scale_));
    if (format_ == MapFormat::ldr8) return unpackLdr8((*codes_)[pixel], mapScale);
    const Rgb v = format_ == MapFormat::rgb9e5 ? unpackRgb9e5((*codes_)[pixel])
                                               : Rgb{(*rgb_[0])[pixel], (*rgb_[1])[pixel], (*rgb_[2])[pixel]};
    return Rgb(Rgbd(v) * scale_);
  }

 private:
  MapFormat format_;
  double scale_;
  std::array<const std::vector<float>*, 3> rgb_{};
  const std::vector<float>* grey_ = nullptr;
  const std::vector<std::uint32_t>* codes_ = nullptr;
};

/// A map on its page.
struct PlacedMap {
  std::uint64_t first;  // into LightMaps::directional
  std::uint16_t psi;
  int x, y, width, height;
  float scale;  // of ldr8
};

/// By page.
std::vector<std::vector<PlacedMap>> mapsByPage(const LightMaps& maps, const DirectionalPages& pages) {
  std::vector<std::vector<PlacedMap>> placed(pages.layers.size());
  const std::int64_t pageTexels = std::int64_t{pages.width} * pages.height;
  std::size_t k = 0, stored = 0;
  for (const SideMaps& side : maps.sides) {
    for (const SideDirection& direction : side.directions) {
      const std::int64_t place = pages.places[k++];
      if (place == DirectionalPages::kNotStored) continue;
      const float scale = pages.mapScales.empty() ? 1.f : pages.mapScales[stored];
      ++stored;
      placed[static_cast<std::size_t>(place / pageTexels)].push_back(
          {direction.first, direction.psi, static_cast<int>(place % pages.width), static_cast<int>(place / pages.width % pages.height),
           side.width, side.height, scale});
    }
  }
  return placed;
}

void readPage(const LayerFile& file, const ExrLayer& layer, const DirectionalPages& pages,
              const std::vector<PlacedMap>& placed, std::vector<Rgb>& texels) {
  const PageReader page(file, layer, pages);
  bool finite = true;
  for (const PlacedMap& map : placed) {
    forEachTexel(map.x, map.y, map.width, map.height, pages.width, [&](std::size_t texel, std::size_t pixel) {
      const Rgb value = page.at(pixel, map.scale);
      finite = finite && isFinite(value);
      texels[map.first + texel] = value;
    });
  }
  if (!finite) file.fail("its values times the scale of the manifest are not finite");
}

struct PageUse {
  /// A page's layer without its values, before any is read.
  std::function<void(const LayerFile&, const ExrLayer&)> check;
  /// When all layers are seen and the number of texels is to be believed.
  std::function<void()> reserve;
  /// A layer with its values and the maps on it; from several threads at once.
  std::function<void(const LayerFile&, const ExrLayer&, const std::vector<PlacedMap>&)> read;
};

void readLayers(const std::filesystem::path& path, const DirectionalPages& pages,
                const std::vector<std::vector<PlacedMap>>& byPage, const PageUse& of) {
  std::optional<LayerFile> file;
  std::vector<std::vector<PlacedMap>> byLayer;
  ExrLayerUse use;
  use.choose = [&](const std::vector<ExrLayer>& heads) {
    file.emplace(path, heads);
    byLayer.resize(heads.size());
    for (std::size_t p = 0; p < pages.layers.size(); ++p) {
      const ExrLayer& layer = file->layer(pages.layers[p], pages.width, pages.height);
      of.check(*file, layer);
      std::vector<PlacedMap>& onLayer = byLayer[file->indexOf(layer)];
      onLayer.insert(onLayer.end(), byPage[p].begin(), byPage[p].end());
    }
    of.reserve();
    std::vector<bool> wanted;
    for (const auto& onLayer : byLayer) wanted.push_back(!onLayer.empty());
    return wanted;
  };
  use.take = [&](std::size_t i, const ExrLayer& layer) { of.read(*file, layer, byLayer[i]); };
  readExrLayers(path, use);
}

void readMeans(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps) {
  const DirectionalPages& pages = contents.pages.directional;
  const std::vector<Vec3d> psis = spreadDirections(maps.directionCount);
  const float reach = meanReach(maps.directionCount);
  PageUse use;
  use.check = [](const LayerFile& file, const ExrLayer& layer) { file.codes(layer, dlm_file::kMeanChannel); };
  use.reserve = [&] { maps.meanDirections.resize(contents.directionalCount); };
  use.read = [&](const LayerFile& file, const ExrLayer& layer, const std::vector<PlacedMap>& placed) {
    const std::vector<std::uint32_t>& codes = file.codes(layer, dlm_file::kMeanChannel);
    for (const PlacedMap& map : placed) {
      const Vec3f psi(psis[map.psi]);
      forEachTexel(map.x, map.y, map.width, map.height, pages.width, [&](std::size_t texel, std::size_t pixel) {
        if (!isMeanCode(codes[pixel])) file.fail("holds a number that is no mean direction");
        maps.meanDirections[map.first + texel] = unpackMean(codes[pixel], psi, reach);
      });
    }
  };
  readLayers(path, pages, mapsByPage(maps, pages), use);
}

void readDirectional(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps) {
  const DirectionalPages& pages = contents.pages.directional;
  PageUse use;
  use.check = [&](const LayerFile& file, const ExrLayer& layer) {
    checkScale(file, layer, pages.scale);
    const PageReader hasItsChannels(file, layer, pages);
  };
  use.reserve = [&] {
    maps.directional.reserve(contents.directionalCount);
    askForHugePages(maps.directional.data(), contents.directionalCount * sizeof(Rgb));
    maps.directional.resize(contents.directionalCount);
  };
  use.read = [&](const LayerFile& file, const ExrLayer& layer, const std::vector<PlacedMap>& placed) {
    readPage(file, layer, pages, placed, maps.directional);
  };
  readLayers(path, pages, mapsByPage(maps, pages), use);
}

}  // namespace

LightMaps readPages(const std::filesystem::path& folder, ManifestContents contents,
                    const std::function<void()>& betweenFiles) {
  LightMaps maps = std::move(contents.maps);
  readIrradiance(folder / dlm_file::kIrradiance, contents, maps);
  betweenFiles();
  if (contents.pages.directional.layers.empty()) return maps;
  readDirectional(folder / dlm_file::kDirectional, contents, maps);
  if (contents.pages.directional.means) readMeans(folder / dlm_file::kMoments, contents, maps);
  return maps;
}

}  // namespace lucarne
