// Directional maps as layers of directional.exr, their mean directions as layers of moments.exr.
#include <cstdio>

#include "dlm/direction_set_cells.h"
#include "dlm/dlm_writer_pages.h"
#include "dlm/mean_direction.h"
#include "dlm/texel_codes.h"

namespace lucarne {
namespace {

ExrLayer emptyPage(const std::string& name, bool neutral, const DirectionalPages& pages) {
  ExrLayer page;
  page.name = name;
  page.width = pages.width;
  page.height = pages.height;
  const auto pixels = static_cast<std::size_t>(pages.width) * static_cast<std::size_t>(pages.height);
  if (isCoded(pages.format) && !neutral) {
    page.channels.push_back({codeChannel(pages.format), ChannelType::uint32, {}, std::vector<std::uint32_t>(pixels)});
    page.attributes["units"] = "lx, coded: see the manifest";
  } else {
    const ChannelType type = pages.format == MapFormat::float32 ? ChannelType::float32 : ChannelType::half;
    const std::vector<const char*> names = neutral ? std::vector{"Y"} : std::vector{"R", "G", "B"};
    for (const char* c : names) page.channels.push_back({c, type, std::vector<float>(pixels), {}});
    page.attributes["units"] = "lx / directional_scale";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", pages.scale);
  page.attributes["directional_scale"] = text;
  return page;
}

/// Puts values into one page.
class TexelWriter {
 public:
  TexelWriter(const DirectionalPages& pages, ExrLayer& page, float mapScale)
      : format_(pages.format), perScale_(1 / pages.scale), mapScale_(mapScale), page_(page) {}
  void put(std::size_t pixel, const Rgb& value) {
    if (page_.channels[0].name == "Y") {
      page_.channels[0].floats[pixel] = static_cast<float>(static_cast<double>(value.x) * perScale_);
      return;
    }
    if (format_ == MapFormat::ldr8) {
      page_.channels[0].uints[pixel] = packLdr8(value, mapScale_);
      return;
    }
    Rgb scaled;
    for (int c = 0; c < 3; ++c) scaled[c] = static_cast<float>(static_cast<double>(value[c]) * perScale_);
    if (format_ == MapFormat::rgb9e5) {
      page_.channels[0].uints[pixel] = packRgb9e5(scaled);
      return;
    }
    for (int c = 0; c < 3; ++c) page_.channels[static_cast<std::size_t>(c)].floats[pixel] = scaled[c];
  }

 private:
  MapFormat format_;
  double perScale_;
  float mapScale_;
  ExrLayer& page_;
};

/// Calls put(pixel, texel) for a map and its gutter of one texel, which repeats the border.
template <class Put>
void forMap(const SideMaps& side, std::int64_t place, const DirectionalPages& pages, Put&& put) {
  const int left = static_cast<int>(place % pages.width), top = static_cast<int>(place / pages.width % pages.height);
  for (int y = std::max(-1, -top); y <= std::min(side.height, pages.height - 1 - top); ++y) {
    for (int x = std::max(-1, -left); x <= std::min(side.width, pages.width - 1 - left); ++x) {
      const int tx = std::clamp(x, 0, side.width - 1), ty = std::clamp(y, 0, side.height - 1);
      const auto pixel = static_cast<std::size_t>(top + y) * static_cast<std::size_t>(pages.width) +
                         static_cast<std::size_t>(left + x);
      put(pixel, static_cast<std::size_t>(ty) * static_cast<std::size_t>(side.width) + static_cast<std::size_t>(tx));
    }
  }
}

/// Calls use(side, direction, place, layer) for every stored map, in order.
template <class Use>
void forStoredMaps(const LightMaps& maps, const DirectionalPages& pages, Use&& use) {
  std::size_t k = 0;
  for (const SideMaps& side : maps.sides) {
    for (const SideDirection& direction : side.directions) {
      const std::int64_t place = pages.places[k++];
      if (place == DirectionalPages::kNotStored) continue;
      use(side, direction, place, static_cast<std::size_t>(place / (std::int64_t{pages.width} * pages.height)));
    }
  }
}

}  // namespace

std::vector<ExrLayer> directionalLayers(const LightMaps& maps, const DirectionalPages& pages) {
  std::vector<ExrLayer> layers;
  for (std::size_t l = 0; l < pages.layers.size(); ++l)
    layers.push_back(emptyPage(pages.layers[l], pages.neutral[l], pages));
  std::size_t stored = 0;
  forStoredMaps(maps, pages, [&](const SideMaps& side, const SideDirection& d, std::int64_t place, std::size_t layer) {
    TexelWriter writer(pages, layers[layer], pages.mapScales.empty() ? 1.f : pages.mapScales[stored++]);
    const Rgb* const texels = maps.directional.data() + d.first;
    forMap(side, place, pages, [&](std::size_t pixel, std::size_t texel) { writer.put(pixel, texels[texel]); });
  });
  return layers;
}

std::vector<ExrLayer> meanLayers(const LightMaps& maps, const DirectionalPages& pages) {
  std::vector<ExrLayer> layers;
  if (!maps.hasMeans()) return layers;
  const auto pixels = static_cast<std::size_t>(pages.width) * static_cast<std::size_t>(pages.height);
  for (const std::string& name : pages.layers) {
    ExrLayer page;
    page.name = name;
    page.width = pages.width;
    page.height = pages.height;
    page.channels.push_back({dlm_file::kMeanChannel, ChannelType::uint32, {}, std::vector<std::uint32_t>(pixels)});
    page.attributes["units"] = "mean direction, coded: see the manifest";
    layers.push_back(std::move(page));
  }
  const std::vector<Vec3d> psis = spreadDirections(maps.directionCount);
  const float reach = meanReach(maps.directionCount, maps.directionFilter);
  forStoredMaps(maps, pages, [&](const SideMaps& side, const SideDirection& d, std::int64_t place, std::size_t layer) {
    const Vec3f* const texels = maps.meanDirections.data() + d.first;
    std::vector<std::uint32_t>& codes = layers[layer].channels[0].uints;
    forMap(side, place, pages, [&](std::size_t pixel, std::size_t texel) {
      codes[pixel] = packMean(texels[texel], Vec3f(psis[d.psi]), reach);
    });
  });
  return layers;
}

}  // namespace lucarne
