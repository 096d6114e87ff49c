#include "tracer/scene/gltf_vertex_split.h"

#include <bit>
#include <unordered_map>

namespace lucarne {
namespace {

struct VertexKey {
  std::uint32_t source, u, v, chart;  // bits of the floats
  bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
  std::size_t operator()(const VertexKey& k) const {
    std::uint64_t h = 0;
    for (const std::uint32_t part : {k.source, k.u, k.v, k.chart}) {
      h = (h ^ part) * 0x9e3779b97f4a7c15u;
      h ^= h >> 32;
    }
    return h;
  }
};

}  // namespace

SplitVertices splitVertices(std::span<const std::array<std::uint32_t, 3>> triangles, std::uint32_t first, bool mirrored,
                            const AtlasUv& uv) {
  SplitVertices split;
  split.indices.reserve(3 * triangles.size());
  std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> known;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t chart = uv.chartOfTriangle[first + t];
    const float chartNumber = chart == kNone ? -1.f : static_cast<float>(chart);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t sceneCorner = mirrored ? (3 - k) % 3 : k;
      const Vec2f place = uv.corner[first + t][sceneCorner];
      const VertexKey key{triangles[t][k], std::bit_cast<std::uint32_t>(place.x), std::bit_cast<std::uint32_t>(place.y),
                          chart};
      const auto [it, isNew] = known.try_emplace(key, static_cast<std::uint32_t>(split.source.size()));
      if (isNew) {
        split.source.push_back(key.source);
        split.uv.push_back(place);
        split.chart.push_back(chartNumber);
      }
      split.indices.push_back(it->second);
    }
  }
  return split;
}

}  // namespace lucarne
