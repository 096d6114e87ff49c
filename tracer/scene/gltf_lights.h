// Punctual lights and cameras of the scene's nodes. Positions are in metres here; the reader moves them into the local
// frame.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/gltf_nodes.h"
#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// KHR_lights_punctual, in node order.
std::vector<Light> readLights(const GltfSource& source, const std::vector<WorldNode>& nodes,
                              std::vector<std::string>& leftOut);

/// Perspective cameras in node order; orthographic ones are left out.
std::vector<Camera> readCameras(const GltfSource& source, const std::vector<WorldNode>& nodes,
                                std::vector<std::string>& leftOut);

}  // namespace lucarne
