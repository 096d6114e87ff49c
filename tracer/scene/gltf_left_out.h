// What a file has and we do not model, in words for a user.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/gltf_nodes.h"
#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// One line a kind of thing. Of materials only those count that triangles of the scene use; of meshes and skins those
/// of the scene's nodes.
std::vector<std::string> listLeftOut(const GltfSource& source, const std::vector<WorldNode>& nodes, const Scene& scene);

}  // namespace lucarne
