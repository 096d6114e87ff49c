// What the player draws by simpler means than the bake traced it.
#pragma once

#include <string>

#include "dlm/light_maps.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// One line: materials of glass, and highlights that so many directions cannot show as narrow as they are. Empty where
/// all is shown as it is.
std::string shownOtherwise(const Scene& scene, const LightMaps& maps);

}  // namespace lucarne
