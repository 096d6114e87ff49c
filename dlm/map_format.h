// How the directional maps are kept on disk. What each costs and loses: docs/formats.md.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "dlm/light_maps.h"

namespace lucarne {

enum class MapFormat : std::uint8_t {
  half,     // 6 bytes a texel, 11 bits of precision
  float32,  // 12 bytes: every bit
  rgb9e5,   // 4 bytes: three numbers of 9 bits with one exponent
  ldr8      // 3 bytes: square roots in 8 bits, a scale for each map, highlights cut at kMax
};

std::string_view nameOf(MapFormat format);
/// Before compression.
int bytesPerTexel(MapFormat format);
/// True where a texel is one whole number: a channel of its own name in directional.exr.
constexpr bool isCoded(MapFormat format) { return format == MapFormat::rgb9e5 || format == MapFormat::ldr8; }
constexpr const char* codeChannel(MapFormat format) { return format == MapFormat::rgb9e5 ? "RGB9E5" : "LDR8"; }

/// Of ldr8: by map (in the order of sides and their stored directions) the value that its largest code stands for.
struct LdrScales {
  std::vector<float> scales;
  double cutFlux = 0;  // share of the sum of all stored values that lies above them
};

/// The scale of a map is its largest component, but at most kMax times the mean component over all stored maps of its side:
/// the paper's k_max (Hey and Purgathofer 2002, section 3.1), so that one bright texel does not take the codes from all.
LdrScales ldrScales(const LightMaps& maps, double kMax);

}  // namespace lucarne
