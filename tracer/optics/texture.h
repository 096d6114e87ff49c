// Texture lookups of the tracer: bilinear (or nearest where the file says so), no mipmaps, glTF wrap modes.
#pragma once

#include "base/vec.h"
#include "tracer/scene/scene.h"

namespace lucarne {

enum class Encoding { linear, srgb };

/// Red, green and blue at uv (before the use's transform), decoded before filtering. White for an absent texture.
Rgb lookUp(const Scene& scene, const TextureUse& use, Vec2f uv, Encoding encoding);

}  // namespace lucarne
