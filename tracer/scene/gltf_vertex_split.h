// Vertices of a primitive split where its triangles disagree about their place in the atlas.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tracer/scene/gltf_writer.h"

namespace lucarne {

struct SplitVertices {
  std::vector<std::uint32_t> source;  // the vertex that each new one is a copy of
  std::vector<Vec2f> uv;
  std::vector<float> chart;
  std::vector<std::uint32_t> indices;  // three a triangle
};

/// `triangles` are the primitive's, in the file's winding; they are number `first` and on of the scene. `mirrored`: the
/// scene has turned their winding round. New vertices are in the order of their first use.
SplitVertices splitVertices(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t first, bool mirrored,
                            const AtlasUv& uv);

}  // namespace lucarne
