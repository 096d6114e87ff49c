// Highlights that a set of directions cannot show as narrow as they are.
#pragma once

#include <nlohmann/json.hpp>

#include "dlm/light_maps.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// [{material, exponent, shown_exponent, textured}]: docs/report.md tells the members.
nlohmann::json widenedHighlightsJson(const Scene& scene, const LightMaps& maps);

}  // namespace lucarne
