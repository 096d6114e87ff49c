#include "app/view/shown_otherwise.h"

#include <algorithm>
#include <vector>

#include "app/widened_highlights.h"

namespace lucarne {

std::string shownOtherwise(const Scene& scene, const LightMaps& maps) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const Triangle& t : scene.triangles) used[t.material] = true;
  std::size_t glass = 0;
  for (std::size_t i = 0; i < used.size(); ++i) glass += used[i] && scene.materials[i].transmits() ? 1 : 0;
  const std::size_t widened = widenedHighlightsJson(scene, maps).size();
  std::string line;
  const auto materials = [](std::size_t n) { return std::to_string(n) + (n == 1 ? " material" : " materials"); };
  if (glass > 0) line = "glass does not bend what is seen through it (" + materials(glass) + ")";
  if (widened > 0) {
    line += std::string(line.empty() ? "" : "; ") + "mirrors and highlights are as wide as a cell of " +
            std::to_string(maps.directionCount) + " directions (" + materials(widened) + ")";
  }
  return line.empty() ? line : "drawn otherwise than baked: " + line;
}

}  // namespace lucarne
