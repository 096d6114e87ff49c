// Materials, textures and images of a scene in memory as glTF JSON.
#pragma once

#include "tracer/scene/gltf_json.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Members "materials", "textures", "samplers", "images" (as PNG data URIs' places: one empty object an image, to be
/// filled by the caller) and "extensionsUsed".
void putMaterials(const Scene& scene, Json& json);

}  // namespace lucarne
