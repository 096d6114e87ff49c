// How tallies and scene lie in the layers of a .part file (docs/part-format.md).
#pragma once

#include "distributed/exr_rows.h"
#include "distributed/part_header.h"

namespace lucarne {

/// Pixels in a row of every layer. A pixel is one (texel, ψ) of the light or the moments, one texel of the statistics, or four bytes
/// of the scene; the last row of a layer is filled up with zeros.
inline constexpr int kPartWidth = 2048;

/// In the order of the file; moments only in parts that have them, the last three only in parts with gathered direct
/// light.
enum class PartLayer : std::uint8_t { scene, light, statistics, moments, directLight, directStatistics, directMoments };

constexpr bool isLight(PartLayer layer) { return layer == PartLayer::light || layer == PartLayer::directLight; }

/// One layer of tallies in a file, and where it stands there.
struct PartTallies {
  PartLayer layer;
  std::size_t index;     // among the layers of the file
  std::uint64_t pixels;  // entries or texels
};
/// Those of a header, in the order of the file.
std::vector<PartTallies> partTallies(const PartHeader& header);

/// The file for a header; throws PartError naming `file` when a layer would be too tall for the format.
ExrRows partRows(const PartHeader& header, const std::string& file);

/// 64-bit values to the low and high words of a row's channels, and back. Values are interleaved as tallies are,
/// [pixel][channel]; channels of a row stand in alphabetical order of the names that partRows() gives them.
void splitRow(PartLayer layer, std::span<const std::int64_t> values, std::span<std::uint32_t> row);
void joinRow(PartLayer layer, std::span<const std::uint32_t> row, std::span<std::int64_t> values);

/// 64-bit values in a pixel of light, statistics or moments.
inline constexpr std::size_t kPartChannels = 3;

/// Behind the image: what reading stops at, and the hash of all bytes before it.
inline constexpr std::size_t kSealBytes = 24;
std::string partSeal(const Hash128& hash);

}  // namespace lucarne
