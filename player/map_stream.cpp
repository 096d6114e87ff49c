#include "player/map_stream.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "base/handover.h"
#include "base/huge_heap.h"
#include "dlm/texel_rows.h"
#include "player/gl_context.h"
#include "player/texel_coding.h"

namespace lucarne {
namespace {

/// The maps of a page as the GPU takes them.
class CodedPage {
 public:
  CodedPage(const DecodedPage& page, LightMapFormat format) : page_(page) {
    const bool same = (page.kind == TexelKind::rgbHalf && format == LightMapFormat::half) ||
                      (page.kind == TexelKind::code && format == LightMapFormat::rgb9e5);
    if (!same) convert(codingOf(format), format == LightMapFormat::half);
  }

  /// Texels of a row in memory; the texels of map `i` of the page.
  GLint rowLength(std::size_t i) const { return converted_.empty() ? static_cast<GLint>(page_.width) : page_.maps[i].width; }
  const std::byte* texels(std::size_t i) const {
    return converted_.empty() ? page_.row(page_.maps[i], 0) : converted_.data() + starts_[i];
  }

 private:
  /// One map after the other, without gaps.
  void convert(const TexelCoding& coding, bool toHalf) {
    std::size_t texels = 0;
    for (const PlacedMap& map : page_.maps) {
      starts_.push_back(texels * coding.bytes);
      texels += static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    }
    converted_.resize(std::max<std::size_t>(texels * coding.bytes, 1));
    std::byte* to = converted_.data();
    std::vector<Rgb> values;
    for (const PlacedMap& map : page_.maps) {
      const auto width = static_cast<std::size_t>(map.width);
      values.resize(std::max(values.size(), width));
      for (int y = 0; y < map.height; ++y, to += width * coding.bytes) {
        const std::byte* row = page_.row(map, y);
        if (toHalf && page_.kind == TexelKind::greyHalf) {
          spreadGrey(row, width, to);
          continue;
        }
        forEachValue(page_.kind, row, width, [&](std::size_t x, Rgb value) { values[x] = withinHalf(value); });
        coding.writeRow({values.data(), width}, 1.f, to);
      }
    }
  }

  static void spreadGrey(const std::byte* row, std::size_t count, std::byte* to) {
    for (std::size_t x = 0; x < count; ++x, to += 8) {
      const std::uint64_t grey = texelAt<std::uint16_t>(row + 2 * x), texel = grey | grey << 16 | grey << 32;
      std::memcpy(to, &texel, sizeof texel);
    }
  }

  /// Files whose channels are floats may hold more.
  static Rgb withinHalf(Rgb v) {
    constexpr float kMost = 65504;
    return {std::min(v.x, kMost), std::min(v.y, kMost), std::min(v.z, kMost)};
  }

  const DecodedPage& page_;
  std::vector<std::size_t> starts_;
  std::vector<std::byte> converted_;
};

class PageSender {
 public:
  PageSender(const MapTables& tables, LightMapFormat format, GLuint texture)
      : tables_(tables), coding_(codingOf(format)), texture_(texture) {}

  void send(const DecodedPage& page, const CodedPage& coded) const {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t i = 0; i < page.maps.size(); ++i) {
      const PlacedMap& map = page.maps[i];
      const LayeredPlace place = placeOf(tables_, map.side, static_cast<int>(map.rank), map.width);
      glPixelStorei(GL_UNPACK_ROW_LENGTH, coded.rowLength(i));
      glTextureSubImage3D(texture_, 0, place.x, place.y, place.layer, map.width, map.height, 1, coding_.layout, coding_.type,
                          coded.texels(i));
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  }

 private:
  const MapTables& tables_;
  TexelCoding coding_;
  GLuint texture_;
};

/// Texels between the maps count for nothing, but must be numbers. Software drivers fill new images, which lie in the
/// program's own memory, with zeros themselves.
GlTexture emptyPages(const LayeredPacking& packing, const PixelCoding& coding, std::size_t bytes) {
  const bool software = isSoftwareDriver(driverName());
  std::optional<HugeHeap> heap;
  if (software) heap.emplace(bytes);
  GlTexture texture = makeTexture({GL_TEXTURE_2D_ARRAY, coding.internal, 1, packing.width, packing.height, packing.layers});
  if (!software) glClearTexImage(texture.get(), 0, coding.layout, coding.type, nullptr);
  return texture;
}

}  // namespace

GlTexture streamDirectional(const MapSource& source, const MapTables& tables, LightMapFormat format) {
  const DirectionalFile& file = *source.directional;
  const PixelCoding coding = codingOf(format);
  const LayeredPacking& packing = tables.directional;
  GlTexture texture = emptyPages(packing, coding, packing.texels() * bytesPerTexel(format));
  const PageSender sender(tables, format, texture.get());
  Handover handover;
  std::size_t done = 0;
  handover.serve([&] {
    file.read({[] {}, [&](const DecodedPage& page) {
                 const CodedPage coded(page, format);
                 handover.run([&] {
                   sender.send(page, coded);
                   if (source.progress) source.progress(static_cast<double>(++done) / static_cast<double>(file.pages()));
                 });
               }});
  });
  return texture;
}

}  // namespace lucarne
