// How tallies and scene lie in the layers of a .part file (docs/part-format.md).
#pragma once

#include "distributed/exr_rows.h"
#include "distributed/part_header.h"

namespace lucarne {

/// Pixels in a row of every layer. A pixel is one (texel, ψ) of the light, one texel of the statistics, or four bytes
/// of the scene; the last row of a layer is filled up with zeros.
inline constexpr int kPartWidth = 2048;

/// In the order of the file; the last two only in parts with gathered direct light.
enum class PartLayer : std::uint8_t { scene, light, statistics, directLight, directStatistics };

constexpr bool isLight(PartLayer layer) { return layer == PartLayer::light || layer == PartLayer::directLight; }

/// The file for a header; throws PartError naming `file` when a layer would be too tall for the format.
ExrRows partRows(const PartHeader& header, const std::string& file);

/// 64-bit values to the low and high words of a row's channels, and back. Values are interleaved as tallies are,
/// [pixel][channel]; channels of a row stand in alphabetical order of the names that partRows() gives them.
void splitRow(PartLayer layer, std::span<const std::int64_t> values, std::span<std::uint32_t> row);
void joinRow(PartLayer layer, std::span<const std::uint32_t> row, std::span<std::int64_t> values);

/// 64-bit values in a pixel of light or statistics.
inline constexpr std::size_t kPartChannels = 3;

/// Behind the image: what reading stops at, and the hash of all bytes before it.
inline constexpr std::size_t kSealBytes = 24;
std::string partSeal(const Hash128& hash);

}  // namespace lucarne
