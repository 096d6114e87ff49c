#include "app/widened_highlights.h"

#include "dlm/lobe_width.h"

namespace lucarne {

nlohmann::json widenedHighlightsJson(const Scene& scene, const LightMaps& maps) {
  nlohmann::json list = nlohmann::json::array();
  for (const WidenedHighlight& w : widenedHighlights(scene, maps)) {
    const std::string& name = scene.materials[w.material].name;
    list.push_back({{"material", name.empty() ? "material " + std::to_string(w.material) : name},
                    {"exponent", w.exponent},
                    {"shown_exponent", w.shownExponent},
                    {"textured", w.textured}});
  }
  return list;
}

}  // namespace lucarne
