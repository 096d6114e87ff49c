// Welding: vertices of a scene that are one point of its surface.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// For each vertex its representative, the vertex of smallest index that it is one with. Equal positions are always
/// one. Vertices nearer than `distance` (local units) are one too where both lie on an open border and no triangle
/// would lose a corner by it: a mesh finer than the tolerance keeps its shape.
std::vector<std::uint32_t> weldVertices(const Scene& scene, double distance);

}  // namespace lucarne
