// Half-edges of a scene (OpenMesh): which triangles continue each other, by position and not by index.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// Where an edge leads: the triangle beyond it, and which of its edges it is there (edge k runs from corner k to k +
/// 1).
struct EdgeLink {
  std::uint32_t triangle = kNone;
  std::uint8_t edge = 0;
};

/// Manifold with border, made by splitting the welded scene where it is not. Two triangles of one material are linked
/// when they wind the same way round and are the only two at their edge. Triangles that lie on one another (the same
/// three points) are layers: each layer is linked by itself, duplicates in order of their index.
struct HalfEdgeMesh {
  std::vector<std::array<std::uint32_t, 3>> vertices;  // per triangle; kNone in degenerate ones
  std::vector<std::array<EdgeLink, 3>> links;          // per triangle; kNone at borders
  std::vector<Vec3d> positions;                        // per vertex, local

  bool degenerate(std::uint32_t triangle) const { return vertices[triangle][0] == kNone; }
  Vec3d corner(std::uint32_t triangle, int k) const { return positions[vertices[triangle][k]]; }
  Vec3d scaledNormal(std::uint32_t triangle) const {
    const Vec3d a = corner(triangle, 0);
    return cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
  }
};

HalfEdgeMesh buildHalfEdgeMesh(const Scene& scene, double weldDistance);

}  // namespace lucarne
