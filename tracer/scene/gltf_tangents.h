// Tangents of the primitives of a glTF document.
#pragma once

#include "tracer/scene/gltf_accessor.h"
#include "tracer/scene/gltf_nodes.h"

namespace lucarne {

/// Scene::tangents of the scene's last instance from the TANGENT attribute of its primitive, turned with the node, made
/// unit and orthogonal to the vertex normals; anyTangent() where the file's is no direction. Where the node mirrors,
/// the bitangent's sign turns round.
void readTangents(const Accessor& tangents, const WorldNode& node, Scene& scene);

}  // namespace lucarne
