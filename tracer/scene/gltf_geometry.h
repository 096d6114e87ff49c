// Triangles and vertices of the scene's primitives.
#pragma once

#include <vector>

#include "tracer/scene/gltf_materials.h"
#include "tracer/scene/gltf_nodes.h"
#include "tracer/scene/gltf_primitives.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The box of all corners in metres, from positions transformed in double precision. InputError for a position that is
/// not finite.
Box trianglesBox(const GltfSource& source, const std::vector<WorldNode>& nodes, const std::vector<PrimitiveUse>& uses);

/// Fills positions, normals, texture coordinates, tangents, triangles, smooth, instances and charts. scene.frame is set
/// before.
void readGeometry(const GltfSource& source, const std::vector<WorldNode>& nodes, const std::vector<PrimitiveUse>& uses,
                  const GltfMaterials& materials, Scene& scene);

}  // namespace lucarne
