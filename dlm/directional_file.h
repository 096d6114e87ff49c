// The directional maps of a .dlm while they are still in their file: given page by page, decoded but as they are coded there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "dlm/manifest.h"

namespace lucarne {

class LayerFile;
struct ExrLayer;

/// How a texel of a page lies in memory.
enum class TexelKind : std::uint8_t {
  rgbHalf,    // four halves: r, g, b, 0
  greyHalf,   // one: r = g = b
  rgbFloat,   // three floats
  greyFloat,  // one
  code        // 32 bits, as the format of the file says
};
constexpr std::size_t bytesOf(TexelKind kind) {
  return kind == TexelKind::rgbHalf ? 8 : kind == TexelKind::greyHalf ? 2 : kind == TexelKind::rgbFloat ? 12 : 4;
}

/// A map on its page.
struct PlacedMap {
  std::uint32_t side;   // into LightMaps::sides
  std::uint32_t rank;   // among the stored maps of its side
  std::uint64_t first;  // into LightMaps::directional
  std::uint16_t psi;
  int x, y, width, height;
  float scale;  // of ldr8
};

/// The part of a page that holds maps. Values that are real numbers are finite in all maps.
struct DecodedPage {
  TexelKind kind = TexelKind::rgbHalf;
  std::size_t width = 0;  // texels in a row
  int firstRow = 0;       // of the page, the first one here
  std::span<const std::byte> texels;
  std::span<const PlacedMap> maps;

  const std::byte* row(const PlacedMap& map, int y) const {
    const auto texel = static_cast<std::size_t>(map.y + y - firstRow) * width + static_cast<std::size_t>(map.x);
    return texels.data() + texel * bytesOf(kind);
  }
};

class DirectionalFile {
 public:
  /// `texels`: of all maps together. The sides of `maps` tell whose maps they are.
  DirectionalFile(std::filesystem::path folder, const LightMaps& maps, DirectionalPages pages, std::uint64_t texels);

  MapFormat format() const { return pages_.format; }
  double scale() const { return pages_.scale; }  // lx = value in the file · scale
  bool hasMeans() const { return pages_.means; }
  std::uint64_t texels() const { return texels_; }
  std::size_t pages() const { return pages_.layers.size(); }
  std::filesystem::path path() const { return folder_ / dlm_file::kDirectional; }
  std::filesystem::path meansPath() const { return folder_ / dlm_file::kMoments; }

  struct Use {
    /// The layers were seen to be as large as the manifest says, so that texels() is to be believed.
    std::function<void()> begin;
    /// A page, gone afterwards; from several threads at once, in no order. What it throws ends the reading.
    std::function<void(const DecodedPage&)> take;
  };
  /// InputError names the file and what is wrong with it.
  void read(const Use& use) const;
  /// The codes of packMean(), at the same places.
  void readMeans(const Use& use) const;

 private:
  using KindOf = std::function<TexelKind(const LayerFile&, const ExrLayer&)>;
  void readPages(const std::filesystem::path& path, const KindOf& kindOf, const char* codes, const Use& use) const;

  std::filesystem::path folder_;
  DirectionalPages pages_;
  std::uint64_t texels_;
  std::vector<std::vector<PlacedMap>> maps_;  // by page
};

/// All of it into maps.directional, and into maps.meanDirections where there are means.
void readInto(const DirectionalFile& file, LightMaps& maps);

}  // namespace lucarne
