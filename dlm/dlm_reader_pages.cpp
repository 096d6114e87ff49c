#include "dlm/dlm_reader_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/image_file.h"
#include "dlm/direction_set_cells.h"
#include "dlm/mean_direction.h"
#include "dlm/texel_codes.h"

namespace lucarne {

namespace {

// The layers of one file, asked for by name.
class LayerFile {
 public:
  explicit LayerFile(const std::filesystem::path& path) : name_(path.string()), layers_(readExr(path)) {}

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

/// Calls use(side, direction, place, number) for every stored map, in order.
template <class Use>
void forStoredMaps(const LightMaps& maps, const DirectionalPages& pages, Use&& use) {
  std::size_t k = 0, stored = 0;
  for (const SideMaps& side : maps.sides) {
    for (const SideDirection& direction : side.directions) {
      const std::int64_t place = pages.places[k++];
      if (place != DirectionalPages::kNotStored) use(side, direction, place, stored++);
    }
  }
}

/// Calls use(texel, pixel) for every texel of the map at a place.
template <class Use>
void forMap(const SideMaps& side, std::int64_t place, const DirectionalPages& pages, Use&& use) {
  forEachTexel(static_cast<int>(place % pages.width), static_cast<int>(place / pages.width % pages.height), side.width,
               side.height, pages.width, use);
}

void readMeans(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps) {
  const DirectionalPages& pages = contents.pages.directional;
  const LayerFile file(path);
  std::vector<const std::vector<std::uint32_t>*> layers;
  for (const std::string& name : pages.layers)
    layers.push_back(&file.codes(file.layer(name, pages.width, pages.height), dlm_file::kMeanChannel));
  const std::vector<Vec3d> psis = spreadDirections(maps.directionCount);
  const float reach = meanReach(maps.directionCount);
  maps.meanDirections.resize(contents.directionalCount);
  const std::int64_t pageTexels = std::int64_t{pages.width} * pages.height;
  forStoredMaps(maps, pages, [&](const SideMaps& side, const SideDirection& d, std::int64_t place, std::size_t) {
    const std::vector<std::uint32_t>& codes = *layers[static_cast<std::size_t>(place / pageTexels)];
    const Vec3f psi(psis[d.psi]);
    forMap(side, place, pages, [&](std::size_t texel, std::size_t pixel) {
      if (!isMeanCode(codes[pixel])) file.fail("holds a number that is no mean direction");
      maps.meanDirections[d.first + texel] = unpackMean(codes[pixel], psi, reach);
    });
  });
}

void readDirectional(const std::filesystem::path& path, const ManifestContents& contents, LightMaps& maps) {
  const DirectionalPages& pages = contents.pages.directional;
  const LayerFile file(path);
  std::vector<PageReader> layers;
  for (const std::string& name : pages.layers) {
    const ExrLayer& layer = file.layer(name, pages.width, pages.height);
    checkScale(file, layer, pages.scale);
    layers.emplace_back(file, layer, pages);
  }
  maps.directional.resize(contents.directionalCount);
  const std::int64_t pageTexels = std::int64_t{pages.width} * pages.height;
  forStoredMaps(maps, pages, [&](const SideMaps& side, const SideDirection& d, std::int64_t place, std::size_t stored) {
    const PageReader& page = layers[static_cast<std::size_t>(place / pageTexels)];
    const float mapScale = pages.mapScales.empty() ? 1.f : pages.mapScales[stored];
    forMap(side, place, pages, [&](std::size_t texel, std::size_t pixel) {
      Rgb& value = maps.directional[d.first + texel];
      value = page.at(pixel, mapScale);
      if (!isFinite(value)) file.fail("its values times the scale of the manifest are not finite");
    });
  });
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
