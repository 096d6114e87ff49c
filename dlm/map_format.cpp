#include "dlm/map_format.h"

#include <algorithm>
#include <span>

namespace lucarne {
namespace {

std::span<const Rgb> texelsOf(const LightMaps& maps, const SideMaps& side, const SideDirection& direction) {
  return {maps.directional.data() + direction.first, side.texelCount()};
}

double sumOf(std::span<const Rgb> texels) {
  double sum = 0;
  for (const Rgb& t : texels) sum += static_cast<double>(t.x) + static_cast<double>(t.y) + static_cast<double>(t.z);
  return sum;
}

float largestOf(std::span<const Rgb> texels) {
  float largest = 0;
  for (const Rgb& t : texels) largest = std::max(largest, maxComponent(t));
  return largest;
}

double cutAt(std::span<const Rgb> texels, float scale) {
  double cut = 0;
  for (const Rgb& t : texels)
    for (int c = 0; c < 3; ++c) cut += static_cast<double>(std::max(0.f, t[c] - scale));
  return cut;
}

/// Mean component over all stored maps of a side; 0: none.
double meanOf(const LightMaps& maps, const SideMaps& side) {
  double sum = 0, stored = 0;
  for (const SideDirection& d : side.directions) {
    if (!d.stored()) continue;
    sum += sumOf(texelsOf(maps, side, d));
    ++stored;
  }
  return stored > 0 ? sum / (3 * stored * static_cast<double>(side.texelCount())) : 0;
}

}  // namespace

std::string_view nameOf(MapFormat format) {
  switch (format) {
    case MapFormat::half: return "half";
    case MapFormat::float32: return "float";
    case MapFormat::rgb9e5: return "rgb9e5";
    case MapFormat::ldr8: break;
  }
  return "ldr8";
}

int bytesPerTexel(MapFormat format) {
  switch (format) {
    case MapFormat::half: return 6;
    case MapFormat::float32: return 12;
    case MapFormat::rgb9e5: return 4;
    case MapFormat::ldr8: break;
  }
  return 3;
}

LdrScales ldrScales(const LightMaps& maps, double kMax) {
  LdrScales result;
  double cut = 0, all = 0;
  for (const SideMaps& side : maps.sides) {
    const double most = kMax * meanOf(maps, side);
    for (const SideDirection& d : side.directions) {
      if (!d.stored()) continue;
      const auto texels = texelsOf(maps, side, d);
      const float scale = std::min(largestOf(texels), static_cast<float>(most));
      result.scales.push_back(scale);
      cut += cutAt(texels, scale);
      all += sumOf(texels);
    }
  }
  result.cutFlux = all > 0 ? cut / all : 0;
  return result;
}

}  // namespace lucarne
