// Image files. OpenEXR multi-part files of named layers, PNG out, Radiance HDR in. Every file read is hostile: sizes are
// checked against `kMaxPixels` and against the file's length before anything is allocated; a bad file is an InputError that
// names it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"

namespace lucarne {

inline constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 30;

/// Linear float image, top row first.
struct ImageRgb {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;
};

enum class ChannelType { half, float32, uint32 };

/// One named channel of a layer. Exactly one of `floats` (half, float32) and `uints` (uint32) is used: width·height values.
struct ExrChannel {
  std::string name;  // "R", "G", "B", "r.lo", …
  ChannelType type = ChannelType::float32;
  std::vector<float> floats;
  std::vector<std::uint32_t> uints;
};

/// One image of a multi-part OpenEXR file. All layers of a file share one size here (OpenEXR wants one displayWindow).
struct ExrLayer {
  std::string name;
  int width = 0, height = 0;
  std::vector<ExrChannel> channels;
  std::map<std::string, std::string> attributes;  // string attributes

  const ExrChannel* find(const std::string& channel) const;
};

enum class ExrCompression { none, rle, zips };

/// Written aside, flushed, renamed. One layer without a name gives a plain single-part scanline file.
void writeExr(const std::filesystem::path& path, const std::vector<ExrLayer>& layers, ExrCompression compression);
/// All scanline layers. half channels are widened to float. Refuses deep and tiled files by name.
std::vector<ExrLayer> readExr(const std::filesystem::path& path);

/// Linear RGB float EXR of one plain layer with channels R, G, B.
void writeExrRgb(const std::filesystem::path& path, const ImageRgb& image);
/// The R, G, B channels (or Y) of the first layer, scanlines or tiles (the largest level). The image is the display
/// window; pixels that the file does not store are black.
ImageRgb readExrRgb(const std::filesystem::path& path);
/// Radiance RGBE .hdr.
ImageRgb readHdr(const std::filesystem::path& path);

/// 8-bit RGB (3 bytes a pixel, already display-coded), top row first.
void writePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

/// PNG or JPEG bytes to RGBA8, sizes checked before decoding; `name` is for the error text.
struct DecodedImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};
DecodedImage decodeImage(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace lucarne
