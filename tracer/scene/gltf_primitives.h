// Which primitives of a document are triangles of the scene, and which vertices each triangle joins. Reader and writer
// share this, so that triangle i is the same to both.
#pragma once

#include <array>
#include <vector>

#include "tracer/scene/gltf_nodes.h"
#include "tracer/scene/gltf_source.h"

namespace lucarne {

/// One triangle primitive as it stands in the scene.
struct PrimitiveUse {
  std::uint32_t worldNode = 0;  // index into flattenNodes
  std::uint32_t node = 0, mesh = 0, primitive = 0;
};

const Json& primitiveJson(const GltfSource& source, std::uint32_t mesh, std::uint32_t primitive);
/// "room.glb: meshes[3] "table".primitives[0]".
Place primitivePlace(const GltfSource& source, std::uint32_t mesh, std::uint32_t primitive);

/// Triangles, a strip or a fan, with positions.
bool hasTriangles(const Json& primitive);
/// Number of its triangles: what is left over of incomplete ones is dropped.
std::uint64_t triangleCountOf(const GltfSource& source, std::uint32_t mesh, std::uint32_t primitive);

/// Nodes in order, primitives in the order of their mesh; those without a whole triangle are left out. InputError when
/// the scene has more than kMaxTriangles.
std::vector<PrimitiveUse> trianglePrimitives(const GltfSource& source, const std::vector<WorldNode>& nodes);
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 26;

/// The vertices of each triangle in the file's own winding. InputError for an index past the vertices.
std::vector<std::array<std::uint32_t, 3>> sourceTriangles(const GltfSource& source, std::uint32_t mesh,
                                                          std::uint32_t primitive);

}  // namespace lucarne
