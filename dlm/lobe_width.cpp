#include "dlm/lobe_width.h"

#include <algorithm>

#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne {

float cellSharpness(int directionCount) { return 1.2f * static_cast<float>(directionCount); }

float lobeSharpness(float alpha, int directionCount) {
  const float lobe = phongFromAlpha(alpha) + 1.f, cell = cellSharpness(directionCount);
  return lobe * cell / (lobe + cell);
}

std::vector<WidenedHighlight> widenedHighlights(const Scene& scene, const LightMaps& maps) {
  constexpr float kMinAlpha = 1e-3f;  // of the shaders
  std::vector<char> hasDirections(scene.materials.size());
  for (const SideMaps& side : maps.sides) {
    if (side.lit && !side.directions.empty()) hasDirections[maps.charts[side.chart].material] = 1;
  }
  std::vector<WidenedHighlight> widened;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    if (hasDirections[m] == 0) continue;
    const Material& material = scene.materials[m];
    const float alpha = std::max(makeBsdf(material, factorsOf(material)).alpha, kMinAlpha);
    if (phongFromAlpha(alpha) + 1.f <= cellSharpness(maps.directionCount)) continue;
    const float shown = lobeSharpness(alpha, maps.directionCount) - 1.f;
    widened.push_back({m, static_cast<double>(phongFromAlpha(alpha)), static_cast<double>(std::max(0.f, shown)),
                       static_cast<bool>(material.metallicRoughnessTexture)});
  }
  return widened;
}

}  // namespace lucarne
