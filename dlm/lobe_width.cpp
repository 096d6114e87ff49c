#include "dlm/lobe_width.h"

#include <algorithm>

#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne {

namespace {

/// λ_cell over what takes its place where light is shared.
constexpr float kTentShare = 0.2f;

}  // namespace

float cellSharpness(int directionCount, DirectionFilter filter) {
  const float cell = 1.2f * static_cast<float>(directionCount);
  return filter == DirectionFilter::linear && directionCount >= 4 ? cell / kTentShare : cell;
}

float lightSharpness(const LightMaps& maps) {
  return cellSharpness(maps.directionCount, maps.hasMeans() ? DirectionFilter::nearest : maps.directionFilter);
}

float lobeSharpness(float alpha, int directionCount, DirectionFilter filter) {
  const float lobe = coatSharpness(alpha), cell = cellSharpness(directionCount, filter);
  return lobe * cell / (lobe + cell);
}

float coatSharpness(float alpha) { return phongFromAlpha(alpha) + 1.f; }

float meanSharpness(float length, int directionCount) {
  constexpr float kLeast = 1e-4f;
  const float r = std::clamp(length, kLeast, 1.f), square = r * r;
  const float spread = (1 - square) / (r * (3 - square));  // 1/κ
  return 1 / (1 / (kMeanBound * cellSharpness(directionCount)) + (1 - 1 / kMeanBound) * spread);
}

std::vector<WidenedHighlight> widenedHighlights(const Scene& scene, const LightMaps& maps) {
  constexpr float kMinAlpha = 1e-3f;  // of the shaders
  std::vector<char> hasDirections(scene.materials.size());
  for (const SideMaps& side : maps.sides) {
    if (side.lit && !side.directions.empty()) hasDirections[maps.charts[side.chart].material] = 1;
  }
  const float cell = cellSharpness(maps.directionCount) * (maps.hasMeans() ? kMeanBound : 1.f);
  std::vector<WidenedHighlight> widened;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    if (hasDirections[m] == 0) continue;
    const Material& material = scene.materials[m];
    const float alpha = std::max(makeBsdf(material, factorsOf(material)).alpha, kMinAlpha);
    const float lobe = coatSharpness(alpha);
    if (lobe <= cell) continue;
    const float shown = lobe * cell / (lobe + cell) - 1.f;
    widened.push_back({m, static_cast<double>(phongFromAlpha(alpha)), static_cast<double>(std::max(0.f, shown)),
                       static_cast<bool>(material.metallicRoughnessTexture)});
  }
  return widened;
}

}  // namespace lucarne
