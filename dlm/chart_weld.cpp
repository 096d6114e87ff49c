#include "dlm/chart_weld.h"

#include <bit>
#include <numeric>
#include <unordered_map>

namespace lucarne {
namespace {

struct Cell {
  std::int64_t x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
};

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = static_cast<std::uint64_t>(c.x) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(c.y)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(c.z)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
  }
};

std::int64_t bitsOf(float x) { return std::bit_cast<std::int32_t>(x + 0.f); }  // + 0: minus zero is zero

std::vector<std::uint32_t> weldEqual(const Scene& scene) {
  std::vector<std::uint32_t> representative(scene.positions.size());
  std::unordered_map<Cell, std::uint32_t, CellHash> first;
  first.reserve(scene.positions.size());
  for (std::uint32_t v = 0; v < representative.size(); ++v) {
    const Vec3f p = scene.positions[v];
    representative[v] = first.try_emplace(Cell{bitsOf(p.x), bitsOf(p.y), bitsOf(p.z)}, v).first->second;
  }
  return representative;
}

struct Edge {
  std::uint32_t a, b, material;
  friend auto operator<=>(const Edge&, const Edge&) = default;
};

std::vector<Edge> sortedEdges(const Scene& scene, const std::vector<std::uint32_t>& representative) {
  std::vector<Edge> edges;
  edges.reserve(3 * scene.triangles.size());
  for (const Triangle& t : scene.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = representative[t.v[k]], b = representative[t.v[(k + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), t.material});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<bool> borderVertices(const Scene& scene, const std::vector<std::uint32_t>& representative) {
  const std::vector<Edge> edges = sortedEdges(scene, representative);
  std::vector<bool> border(representative.size(), false);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool single = (i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]);
    if (single) border[edges[i].a] = border[edges[i].b] = true;
  }
  return border;
}

/// Joins border vertices that are near each other, in order of their index, through a grid whose cells are one weld
/// distance wide.
class NearbyWelder {
 public:
  NearbyWelder(const Scene& scene, std::vector<std::uint32_t>& representative, double distance)
      : scene_(scene), representative_(representative), distance_(distance), joined_(representative) {
    listTriangles();
  }

  void run(const std::vector<bool>& border) {
    for (std::uint32_t v = 0; v < joined_.size(); ++v) {
      if (representative_[v] != v || !border[v] || !isFinite(scene_.positions[v])) continue;
      const std::uint32_t near = findNear(v);
      if (near == kNone)
        cells_[cellOf(v)].push_back(v);
      else
        joined_[v] = near;
    }
    for (std::uint32_t& r : representative_) r = joined_[r];
  }

 private:
  void listTriangles() {
    firstOf_.assign(joined_.size() + 1, 0);
    for (const Triangle& t : scene_.triangles) {
      for (const std::uint32_t v : t.v) ++firstOf_[representative_[v] + 1];
    }
    std::partial_sum(firstOf_.begin(), firstOf_.end(), firstOf_.begin());
    trianglesOf_.resize(3 * scene_.triangles.size());
    std::vector<std::size_t> next(firstOf_.begin(), firstOf_.end() - 1);
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
      for (const std::uint32_t v : scene_.triangles[t].v) trianglesOf_[next[representative_[v]]++] = t;
    }
  }

  Cell cellOf(std::uint32_t v) const {
    const Vec3d p = Vec3d(scene_.positions[v]) / distance_;
    return {static_cast<std::int64_t>(std::floor(p.x)), static_cast<std::int64_t>(std::floor(p.y)),
            static_cast<std::int64_t>(std::floor(p.z))};
  }

  std::uint32_t findNear(std::uint32_t v) const {
    const Cell c = cellOf(v);
    std::uint32_t best = kNone;
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(Cell{c.x + i % 3 - 1, c.y + i / 3 % 3 - 1, c.z + i / 9 - 1});
      if (found == cells_.end()) continue;
      for (const std::uint32_t w : found->second) {
        const Vec3d d = Vec3d(scene_.positions[v]) - Vec3d(scene_.positions[w]);
        if (w < best && dot(d, d) <= distance_ * distance_ && !shareTriangle(v, w)) best = w;
      }
    }
    return best;
  }

  /// Whether some triangle at `v` already has a corner in the class of `w`.
  bool shareTriangle(std::uint32_t v, std::uint32_t w) const {
    for (std::size_t i = firstOf_[v]; i < firstOf_[v + 1]; ++i) {
      for (const std::uint32_t corner : scene_.triangles[trianglesOf_[i]].v) {
        if (joined_[representative_[corner]] == w) return true;
      }
    }
    return false;
  }

  const Scene& scene_;
  std::vector<std::uint32_t>& representative_;
  double distance_;
  std::vector<std::uint32_t> joined_;  // of representatives
  std::vector<std::size_t> firstOf_;
  std::vector<std::uint32_t> trianglesOf_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;
};

}  // namespace

std::vector<std::uint32_t> weldVertices(const Scene& scene, double distance) {
  std::vector<std::uint32_t> representative = weldEqual(scene);
  if (distance > 0) NearbyWelder(scene, representative, distance).run(borderVertices(scene, representative));
  return representative;
}

}  // namespace lucarne
