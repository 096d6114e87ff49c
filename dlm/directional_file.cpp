#include "dlm/directional_file.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "base/exr_pixels.h"
#include "dlm/layer_file.h"
#include "dlm/texel_rows.h"

namespace lucarne {
namespace {

/// By page.
std::vector<std::vector<PlacedMap>> mapsByPage(const LightMaps& maps, const DirectionalPages& pages) {
  std::vector<std::vector<PlacedMap>> placed(pages.layers.size());
  const std::int64_t pageTexels = std::int64_t{pages.width} * pages.height;
  std::size_t k = 0, stored = 0;
  for (std::uint32_t s = 0; s < maps.sides.size(); ++s) {
    const SideMaps& side = maps.sides[s];
    std::uint32_t rank = 0;
    for (const SideDirection& direction : side.directions) {
      const std::int64_t place = pages.places[k++];
      if (place == DirectionalPages::kNotStored) continue;
      const float scale = pages.mapScales.empty() ? 1.f : pages.mapScales[stored];
      ++stored;
      placed[static_cast<std::size_t>(place / pageTexels)].push_back(
          {s, rank++, direction.first, direction.psi, static_cast<int>(place % pages.width),
           static_cast<int>(place / pages.width % pages.height), side.width, side.height, scale});
    }
  }
  return placed;
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

TexelKind lightKind(const LayerFile& file, const ExrLayer& layer, const DirectionalPages& pages) {
  checkScale(file, layer, pages.scale);
  if (layer.channels.size() == 1 && layer.channels[0].name == "Y")
    return file.realChannel(layer, "Y").type == ChannelType::half ? TexelKind::greyHalf : TexelKind::greyFloat;
  if (isCoded(pages.format)) {
    file.wholeChannel(layer, codeChannel(pages.format));
    return TexelKind::code;
  }
  bool half = true;
  for (const char* channel : {"R", "G", "B"}) half &= file.realChannel(layer, channel).type == ChannelType::half;
  return half ? TexelKind::rgbHalf : TexelKind::rgbFloat;
}

ExrWish wishFor(TexelKind kind, const char* codes, const std::vector<PlacedMap>& maps) {
  constexpr ChannelType h = ChannelType::half, f = ChannelType::float32;
  ExrWish wish;
  switch (kind) {
    case TexelKind::rgbHalf: wish.slots = {{"R", h}, {"G", h}, {"B", h}, {"A", h}}; break;
    case TexelKind::greyHalf: wish.slots = {{"Y", h}}; break;
    case TexelKind::rgbFloat: wish.slots = {{"R", f}, {"G", f}, {"B", f}}; break;
    case TexelKind::greyFloat: wish.slots = {{"Y", f}}; break;
    case TexelKind::code: wish.slots = {{codes, ChannelType::uint32}}; break;
  }
  if (maps.empty()) return wish;
  wish.firstRow = maps.front().y;
  for (const PlacedMap& map : maps) {
    wish.firstRow = std::min(wish.firstRow, map.y);
    wish.endRow = std::max(wish.endRow, map.y + map.height);
  }
  return wish;
}

/// Without a branch, so that many are looked at at once.
template <class Bits>
bool anyNotFinite(const std::byte* from, std::size_t count, Bits exponent) {
  bool found = false;
  for (std::size_t i = 0; i < count; ++i) found |= (texelAt<Bits>(from + i * sizeof(Bits)) & exponent) == exponent;
  return found;
}

void checkFinite(const LayerFile& file, const ExrLayer& layer, const DecodedPage& page) {
  if (page.kind == TexelKind::code) return;
  const bool half = page.kind == TexelKind::rgbHalf || page.kind == TexelKind::greyHalf;
  const std::size_t perTexel = bytesOf(page.kind) / (half ? 2 : 4);
  bool found = false;
  for (const PlacedMap& map : page.maps) {
    const std::size_t count = static_cast<std::size_t>(map.width) * perTexel;
    for (int y = 0; y < map.height; ++y) {
      const std::byte* row = page.row(map, y);
      found |= half ? anyNotFinite<std::uint16_t>(row, count, 0x7c00) : anyNotFinite<std::uint32_t>(row, count, 0x7f800000);
    }
  }
  if (found) file.fail("the layer \"" + layer.name + "\" holds a number that is not finite");
}

}  // namespace

DirectionalFile::DirectionalFile(std::filesystem::path folder, const LightMaps& maps, DirectionalPages pages,
                                 std::uint64_t texels)
    : folder_(std::move(folder)), pages_(std::move(pages)), texels_(texels), maps_(mapsByPage(maps, pages_)) {
  pages_.places = {};
}

void DirectionalFile::readPages(const std::filesystem::path& path, const KindOf& kindOf, const char* codes, const Use& use) const {
  std::optional<LayerFile> file;
  std::vector<std::vector<PlacedMap>> byLayer;
  std::vector<TexelKind> kinds;
  ExrPixelUse pixels;
  pixels.choose = [&](const std::vector<ExrLayer>& heads) {
    file.emplace(path, heads);
    byLayer.resize(heads.size());
    kinds.resize(heads.size());
    for (std::size_t p = 0; p < pages_.layers.size(); ++p) {
      const ExrLayer& layer = file->layer(pages_.layers[p], pages_.width, pages_.height);
      const std::size_t i = file->indexOf(layer);
      kinds[i] = kindOf(*file, layer);
      byLayer[i].insert(byLayer[i].end(), maps_[p].begin(), maps_[p].end());
    }
    use.begin();
    std::vector<ExrWish> wishes;
    for (std::size_t i = 0; i < heads.size(); ++i) wishes.push_back(byLayer[i].empty() ? ExrWish{} : wishFor(kinds[i], codes, byLayer[i]));
    if (!wishes.empty() && wishes.back().any()) wishes.back().endRow = heads.back().height;  // so that a file that is cut short is noticed
    return wishes;
  };
  pixels.take = [&](std::size_t i, std::span<const std::byte> texels) {
    const int firstRow = wishFor(kinds[i], codes, byLayer[i]).firstRow;
    const DecodedPage page{kinds[i], static_cast<std::size_t>(pages_.width), firstRow, texels, byLayer[i]};
    checkFinite(*file, file->at(i), page);
    use.take(page);
  };
  readExrPixels(path, pixels);
}

void DirectionalFile::read(const Use& use) const {
  const auto kindOf = [this](const LayerFile& file, const ExrLayer& layer) { return lightKind(file, layer, pages_); };
  readPages(path(), kindOf, isCoded(pages_.format) ? codeChannel(pages_.format) : "", use);
}

void DirectionalFile::readMeans(const Use& use) const {
  const auto kindOf = [](const LayerFile& file, const ExrLayer& layer) {
    file.wholeChannel(layer, dlm_file::kMeanChannel);
    return TexelKind::code;
  };
  readPages(meansPath(), kindOf, dlm_file::kMeanChannel, use);
}

}  // namespace lucarne
