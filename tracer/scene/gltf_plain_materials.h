// Materials, textures and images of a scene in memory as glTF JSON.
#pragma once

#include "tracer/scene/gltf_json.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Members "materials", "textures", "samplers", "images" and "extensionsUsed". Images get a name of a file as their
/// URI; the caller provides the bytes.
void putMaterials(const Scene& scene, Json& json);

}  // namespace lucarne
