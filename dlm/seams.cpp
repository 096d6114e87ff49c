#include "dlm/seams.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "dlm/edge_overlaps.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {

constexpr double kSameNormal = 0.99939;  // cos 2°
constexpr double kSamplesATexel = 2;

/// An edge of a triangle, its ends in an order that does not depend on the triangle.
struct Edge {
  std::array<std::uint32_t, 6> ends;  // bits of both positions
  std::uint32_t triangle;
  std::uint8_t corner;  // runs to the next
  bool turned;          // runs from the second end to the first
};

std::array<std::uint32_t, 3> bitsOf(Vec3f p) {
  return {std::bit_cast<std::uint32_t>(p.x + 0.f), std::bit_cast<std::uint32_t>(p.y + 0.f),
          std::bit_cast<std::uint32_t>(p.z + 0.f)};
}

std::vector<Edge> sortedEdges(const Scene& scene) {
  std::vector<Edge> edges;
  edges.reserve(3 * scene.triangles.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (isSkipped(scene, t)) continue;
    for (std::uint8_t k = 0; k < 3; ++k) {
      auto from = bitsOf(scene.corner(t, k)), to = bitsOf(scene.corner(t, (k + 1) % 3));
      if (from == to) continue;
      const bool turned = to < from;
      if (turned) std::swap(from, to);
      edges.push_back({{from[0], from[1], from[2], to[0], to[1], to[2]}, t, k, turned});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.ends, a.triangle, a.corner) < std::tie(b.ends, b.triangle, b.corner);
  });
  return edges;
}

Vec3d shadingNormal(const Scene& scene, std::uint32_t t, int corner) {
  const bool smooth = t < scene.smooth.size() && scene.smooth[t] != 0;
  return smooth ? Vec3d(scene.normals[scene.triangles[t].v[corner]]) : normalize(scene.scaledNormal(t));
}

SideLookup lookUp(const SideMaps& side, Vec2d st) {
  const double s = std::clamp(st.x - 0.5, 0.0, side.width - 1.0), t = std::clamp(st.y - 0.5, 0.0, side.height - 1.0);
  const int x0 = static_cast<int>(s), y0 = static_cast<int>(t);
  const int x1 = std::min(x0 + 1, side.width - 1), y1 = std::min(y0 + 1, side.height - 1);
  const double fx = s - x0, fy = t - y0;
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * side.width + x); };
  return {{at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1)},
          {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

/// Part of a triangle's edge; begin > end where it is run against the triangle's sense.
struct EdgePart {
  std::uint32_t triangle;
  std::uint8_t corner;  // the edge runs to the next
  double begin, end;    // fractions of the edge
};

Segment segmentOf(const Scene& scene, const Edge& e) {
  return {Vec3d(scene.corner(e.triangle, e.corner)), Vec3d(scene.corner(e.triangle, (e.corner + 1) % 3))};
}

Vec3d shadingNormal(const Scene& scene, const EdgePart& part, double fraction) {
  return normalize(shadingNormal(scene, part.triangle, part.corner) * (1 - fraction) +
                   shadingNormal(scene, part.triangle, (part.corner + 1) % 3) * fraction);
}

bool sameShading(const Scene& scene, const EdgePart& a, const EdgePart& b) {
  return dot(shadingNormal(scene, a, a.begin), shadingNormal(scene, b, b.begin)) >= kSameNormal &&
         dot(shadingNormal(scene, a, a.end), shadingNormal(scene, b, b.end)) >= kSameNormal;
}

class SeamFinder {
 public:
  SeamFinder(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const LightMaps& maps,
             std::span<const SideContacts> contacts)
      : scene_(scene), charts_(charts), layout_(layout), maps_(maps), contacts_(contacts) {}

  SeamSet find() {
    const std::vector<Edge> edges = sortedEdges(scene_);
    std::vector<Edge> alone;
    std::vector<Segment> others;
    for (std::size_t i = 0; i < edges.size();) {
      std::size_t end = i;
      while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
      if (end - i == 2 && edges[i].turned != edges[i + 1].turned)  // the second runs the other way
        consider({edges[i].triangle, edges[i].corner, 0, 1}, {edges[i + 1].triangle, edges[i + 1].corner, 1, 0});
      if (end - i == 1)
        alone.push_back(edges[i]);
      else
        others.push_back(segmentOf(scene_, edges[i]));
      i = end;
    }
    considerOverlaps(alone, others);
    return std::move(set_);
  }

 private:
  /// Edges that share no ends. A normal n and the direction d that the edge is run in give the side n × d on which the
  /// triangle lies; with d and −d, the sides are opposite where the normals are less than 90° apart.
  void considerOverlaps(const std::vector<Edge>& alone, const std::vector<Segment>& others) {
    std::vector<Segment> segments;
    for (const Edge& e : alone) segments.push_back(segmentOf(scene_, e));
    for (const EdgeOverlap& o : findEdgeOverlaps(segments, others, ChartOptions{}.weldTolerance)) {
      const Edge &a = alone[o.a], &b = alone[o.b];
      if (o.bBegin < o.bEnd || !(dot(scene_.scaledNormal(a.triangle), scene_.scaledNormal(b.triangle)) > 0)) continue;
      consider({a.triangle, a.corner, o.aBegin, o.aEnd}, {b.triangle, b.corner, o.bBegin, o.bEnd});
    }
  }

  void consider(const EdgePart& a, const EdgePart& b) {
    const std::uint32_t chartA = charts_.chartOfTriangle[a.triangle], chartB = charts_.chartOfTriangle[b.triangle];
    if (chartA == chartB || chartA == kNone || chartB == kNone || !sameShading(scene_, a, b)) return;
    addSeam(a, b, maps_.charts[chartA].frontSide, maps_.charts[chartB].frontSide);
    addSeam(a, b, maps_.charts[chartA].backSide, maps_.charts[chartB].backSide);
  }

  Vec2d texelOf(const EdgePart& part, double fraction) const {
    const auto& uv = charts_.cornerUv[part.triangle];
    const Vec2f from = uv[part.corner], to = uv[(part.corner + 1u) % 3];
    const auto at = [fraction](float x, float y) {
      return static_cast<double>(x) * (1 - fraction) + static_cast<double>(y) * fraction;
    };
    const Vec2d scale = layout_.charts[charts_.chartOfTriangle[part.triangle]].texelsPerLocal;
    return {at(from.x, to.x) * scale.x, at(from.y, to.y) * scale.y};
  }

  bool touched(std::uint32_t side, const SideLookup& look) const {
    if (contacts_.empty() || contacts_[side].empty()) return false;
    return std::any_of(look.texel.begin(), look.texel.end(),
                       [&](std::uint32_t t) { return contacts_[side].touched(t); });
  }

  void addSeam(const EdgePart& a, const EdgePart& b, std::uint32_t sideA, std::uint32_t sideB) {
    if (sideA == kNone || sideB == kNone || !maps_.sides[sideA].lit || !maps_.sides[sideB].lit) return;
    const Vec2d a0 = texelOf(a, a.begin), a1 = texelOf(a, a.end), b0 = texelOf(b, b.begin), b1 = texelOf(b, b.end);
    const double texels = std::max(std::hypot(a1.x - a0.x, a1.y - a0.y), std::hypot(b1.x - b0.x, b1.y - b0.y));
    const double metres =
        scene_.frame.scale * std::abs(a.end - a.begin) *
        length(Vec3d(scene_.corner(a.triangle, (a.corner + 1) % 3)) - Vec3d(scene_.corner(a.triangle, a.corner)));
    const int n = std::max(1, static_cast<int>(std::ceil(kSamplesATexel * texels)));
    Seam seam{set_.samples.size(), 0};
    for (int i = 0; i < n; ++i) {
      const double f = (i + 0.5) / n;
      const SeamSample sample{sideA, sideB, lookUp(maps_.sides[sideA], a0 + (a1 - a0) * f),
                              lookUp(maps_.sides[sideB], b0 + (b1 - b0) * f), metres / n};
      if (!touched(sideA, sample.a) && !touched(sideB, sample.b)) set_.samples.push_back(sample);
    }
    seam.end = set_.samples.size();
    if (seam.end > seam.first) set_.seams.push_back(seam);
  }

  const Scene& scene_;
  const ChartSet& charts_;
  const TexelLayout& layout_;
  const LightMaps& maps_;
  std::span<const SideContacts> contacts_;
  SeamSet set_;
};

}  // namespace

SeamSet findSeams(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const LightMaps& maps,
                  std::span<const SideContacts> contacts) {
  return SeamFinder(scene, charts, layout, maps, contacts).find();
}

}  // namespace lucarne
