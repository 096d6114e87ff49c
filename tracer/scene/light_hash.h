// A scene by what light touches.
#pragma once

#include "base/hash.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Equal for scenes that every photon meets alike: triangles with their materials and textures, lamps, and the
/// densities that the file asks for. Not in it: cameras, names, materials and images that no triangle uses, extras,
/// animations, and how the file is cut into buffers.
Hash128 lightHash(const Scene& scene);

/// One material of the scene, textures included, without its name; and one light, without its name.
Hash128 lightHash(const Scene& scene, const Material& material);
Hash128 lightHash(const Light& light);

}  // namespace lucarne
