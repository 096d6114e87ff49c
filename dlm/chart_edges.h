// Pairing of triangle edges: the part of mesh building that decides what is manifold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

using Corners = std::array<std::uint32_t, 3>;  // welded vertices of a triangle, kNone in degenerate ones

/// Half-edge 3·t + k runs from corner k of triangle t to its corner k + 1. Returns for each its partner, or kNone: see
/// HalfEdgeMesh for the rule.
std::vector<std::uint32_t> pairHalfEdges(const std::vector<Corners>& corners, const std::vector<Triangle>& triangles);

}  // namespace lucarne
