// What a chart side requires: model only that.
#pragma once

#include "tracer/scene/scene.h"

namespace lucarne {

enum class Need { nothing, irradiance, directions };

/// Nothing where no light is taken (unlit materials). Directions where the material has a coat sharp enough to show them. A coat of Phong exponent below ½ (roughness above
/// about 0.84) is so wide that its highlight is the irradiance; a textured roughness may be sharp anywhere.
Need needOf(const Material& material);

}  // namespace lucarne
