#include "tracer/scene/png_bytes.h"

#include <algorithm>
#include <span>
#include <string_view>

namespace lucarne {
namespace {

using Bytes = std::vector<std::uint8_t>;

void putBigEndian(Bytes& out, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(word >> shift));
}

/// CRC-32 of ISO 3309, as PNG wants it.
std::uint32_t crc(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0xffffffffu;
  for (const std::uint8_t byte : bytes) {
    value ^= byte;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0);
  }
  return ~value;
}

std::uint32_t adler(std::span<const std::uint8_t> bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

/// zlib stream (RFC 1950) of stored blocks (RFC 1951, 3.2.4).
Bytes storedZlib(std::span<const std::uint8_t> data) {
  Bytes out = {0x78, 0x01};
  for (std::size_t at = 0; at < data.size();) {
    const std::size_t size = std::min<std::size_t>(data.size() - at, 65535);
    out.push_back(at + size == data.size());
    for (const std::size_t word : {size, ~size}) {
      out.push_back(static_cast<std::uint8_t>(word));
      out.push_back(static_cast<std::uint8_t>(word >> 8));
    }
    out.insert(out.end(), data.begin() + static_cast<std::ptrdiff_t>(at),
               data.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
  }
  putBigEndian(out, adler(data));
  return out;
}

void putChunk(Bytes& png, std::string_view type, const Bytes& data) {
  putBigEndian(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  putBigEndian(png, crc(std::span(png).subspan(start)));
}

}  // namespace

std::vector<std::uint8_t> storedPng(const Image& image) {
  const auto row = static_cast<std::ptrdiff_t>(image.width) * 4;
  Bytes lines;
  for (std::ptrdiff_t y = 0; y < image.height; ++y) {
    lines.push_back(0);  // no filter
    lines.insert(lines.end(), image.rgba.begin() + y * row, image.rgba.begin() + (y + 1) * row);
  }
  Bytes header;
  putBigEndian(header, static_cast<std::uint32_t>(image.width));
  putBigEndian(header, static_cast<std::uint32_t>(image.height));
  header.insert(header.end(), {8, 6, 0, 0, 0});  // 8 bits, RGBA
  Bytes png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  putChunk(png, "IHDR", header);
  putChunk(png, "IDAT", storedZlib(lines));
  putChunk(png, "IEND", {});
  return png;
}

}  // namespace lucarne
