// Directional maps as layers of directional.exr.
#include <cstdio>

#include "dlm/dlm_writer_pages.h"
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

/// A map with its gutter of one texel, which repeats the border.
void writeMap(const SideMaps& side, const Rgb* texels, int left, int top, const DirectionalPages& pages,
              TexelWriter& writer) {
  for (int y = std::max(-1, -top); y <= std::min(side.height, pages.height - 1 - top); ++y) {
    for (int x = std::max(-1, -left); x <= std::min(side.width, pages.width - 1 - left); ++x) {
      const int tx = std::clamp(x, 0, side.width - 1), ty = std::clamp(y, 0, side.height - 1);
      const auto pixel = static_cast<std::size_t>(top + y) * static_cast<std::size_t>(pages.width) +
                         static_cast<std::size_t>(left + x);
      writer.put(pixel, texels[static_cast<std::size_t>(ty) * static_cast<std::size_t>(side.width) +
                               static_cast<std::size_t>(tx)]);
    }
  }
}

}  // namespace

std::vector<ExrLayer> directionalLayers(const LightMaps& maps, const DirectionalPages& pages) {
  std::vector<ExrLayer> layers;
  for (std::size_t l = 0; l < pages.layers.size(); ++l)
    layers.push_back(emptyPage(pages.layers[l], pages.neutral[l], pages));
  std::size_t k = 0, stored = 0;
  for (const SideMaps& side : maps.sides) {
    for (const SideDirection& direction : side.directions) {
      const std::int64_t place = pages.places[k++];
      if (place == DirectionalPages::kNotStored) continue;
      ExrLayer& page = layers[static_cast<std::size_t>(place / (std::int64_t{pages.width} * pages.height))];
      TexelWriter writer(pages, page, pages.mapScales.empty() ? 1.f : pages.mapScales[stored]);
      ++stored;
      writeMap(side, maps.directional.data() + direction.first, static_cast<int>(place % pages.width),
               static_cast<int>(place / pages.width % pages.height), pages, writer);
    }
  }
  return layers;
}

}  // namespace lucarne
