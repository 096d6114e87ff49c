#include "dlm/chart_uv1.h"

#include <cstdio>
#include <numeric>

#include "dlm/chart_overlap.h"
#include "dlm/chart_plane.h"

namespace lucarne {
namespace {

constexpr float kSlack = 1e-4f;         // beyond 0..1, as exporters round
constexpr float kSamePlace = 1e-5f;     // of two corners in the unwrapping
constexpr double kOverlapDepth = 1e-6;  // less is rounding

PlaneTriangle unwrapped(const Scene& scene, std::uint32_t triangle) {
  PlaneTriangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2f uv = scene.atlasUv[scene.triangles[triangle].v[k]];
    t[k] = {static_cast<double>(uv.x), static_cast<double>(uv.y)};
  }
  return t;
}

double signedArea(const PlaneTriangle& t) {
  const Vec2d a = t[1] - t[0], b = t[2] - t[0];
  return 0.5 * (a.x * b.y - a.y * b.x);
}

bool insideSquare(Vec2f uv) {
  return uv.x >= -kSlack && uv.y >= -kSlack && uv.x <= 1 + kSlack && uv.y <= 1 + kSlack;  // NaN is not
}

bool hasUnwrapping(const Scene& scene, const PrimitiveInstance& instance) {
  for (std::uint32_t v = instance.firstVertex; v < instance.firstVertex + instance.vertexCount; ++v)
    if (!(scene.atlasUv[v] == Vec2f{})) return true;  // the reader fills in zeros where a primitive has none
  return false;
}

std::string placeText(Vec2f uv) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.4g, %.4g)", static_cast<double>(uv.x), static_cast<double>(uv.y));
  return text;
}

/// Empty when the unwrapping can be used.
std::string whyNot(const Scene& scene, const HalfEdgeMesh& mesh, const PrimitiveInstance& instance) {
  PlaneTriangleSet laid(2, kOverlapDepth);
  for (std::uint32_t t = instance.firstTriangle; t < instance.firstTriangle + instance.triangleCount; ++t) {
    if (mesh.degenerate(t)) continue;
    for (const std::uint32_t v : scene.triangles[t].v)
      if (!insideSquare(scene.atlasUv[v])) return "leaves 0..1 at " + placeText(scene.atlasUv[v]);
    PlaneTriangle triangle = unwrapped(scene, t);
    const std::string here = placeText(scene.atlasUv[scene.triangles[t].v[0]]);
    const double area = signedArea(triangle);
    if (std::abs(area) < 1e-12) return "has a triangle without area at " + here;
    if (area < 0) std::swap(triangle[1], triangle[2]);
    if (!laid.tryAdd(triangle)) return "overlaps itself at " + here;
  }
  return {};
}

/// Sets of triangles, joined two at a time.
class Islands {
 public:
  explicit Islands(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t of(std::uint32_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

bool goOnUnwrapped(const Scene& scene, std::uint32_t t, int k, EdgeLink link) {
  const auto same = [&](std::uint32_t v, std::uint32_t w) {
    const Vec2f d = scene.atlasUv[v] - scene.atlasUv[w];
    return std::abs(d.x) <= kSamePlace && std::abs(d.y) <= kSamePlace;
  };
  const std::uint32_t *here = scene.triangles[t].v, *there = scene.triangles[link.triangle].v;
  return same(here[k], there[(link.edge + 1) % 3]) && same(here[(k + 1) % 3], there[link.edge]) &&
         (signedArea(unwrapped(scene, t)) > 0) == (signedArea(unwrapped(scene, link.triangle)) > 0);
}

void joinNeighbours(const Scene& scene, const HalfEdgeMesh& mesh, const PrimitiveInstance& instance, Islands& islands) {
  const std::uint32_t end = instance.firstTriangle + instance.triangleCount;
  for (std::uint32_t t = instance.firstTriangle; t < end; ++t)
    for (int k = 0; k < 3; ++k) {
      const EdgeLink link = mesh.links[t][static_cast<std::size_t>(k)];
      if (link.triangle == kNone || link.triangle < instance.firstTriangle || link.triangle >= end) continue;
      if (goOnUnwrapped(scene, t, k, link)) islands.join(t, link.triangle);
    }
}

/// Mean normal by area; of a closed island, whose normals cancel, that of its first triangle.
Vec3d meanNormal(const Scene& scene, const std::vector<std::uint32_t>& island) {
  Vec3d sum;
  double whole = 0;
  for (const std::uint32_t t : island) {
    sum += scene.scaledNormal(t);
    whole += length(scene.scaledNormal(t));
  }
  return snappedNormal(length(sum) > 1e-6 * whole ? sum : scene.scaledNormal(island[0]));
}

}  // namespace

Uv1Islands findUv1Islands(const Scene& scene, const HalfEdgeMesh& mesh) {
  Uv1Islands result;
  if (scene.atlasUv.size() != scene.positions.size()) return result;
  Islands islands(scene.triangles.size());
  std::vector<std::vector<std::uint32_t>> byRoot(scene.triangles.size());
  for (const PrimitiveInstance& instance : scene.instances) {
    if (!hasUnwrapping(scene, instance)) continue;
    if (const std::string why = whyNot(scene, mesh, instance); !why.empty()) {
      result.refused.push_back("TEXCOORD_1 of mesh " + std::to_string(instance.mesh) + ", primitive " +
                               std::to_string(instance.primitive) + ", " + why);
      continue;
    }
    joinNeighbours(scene, mesh, instance, islands);
    for (std::uint32_t t = instance.firstTriangle; t < instance.firstTriangle + instance.triangleCount; ++t)
      if (!mesh.degenerate(t)) byRoot[islands.of(t)].push_back(t);
  }
  for (auto& island : byRoot)
    if (!island.empty()) result.islands.push_back(std::move(island));
  std::sort(result.refused.begin(), result.refused.end());
  result.refused.erase(std::unique(result.refused.begin(), result.refused.end()), result.refused.end());
  return result;
}

Chart uv1Chart(const Scene& scene, const std::vector<std::uint32_t>& island, double minSize, ChartSet& set) {
  Chart chart;
  chart.material = scene.triangles[island[0]].material;
  chart.triangles = island;
  chart.normal = meanNormal(scene, island);
  planeAxes(chart.normal, chart.axisU, chart.axisV);
  double laid = 0;
  Box box;
  const bool mirrored = signedArea(unwrapped(scene, island[0])) < 0;
  const auto placeOf = [&](Vec2d uv) { return Vec3d{mirrored ? -uv.x : uv.x, uv.y, 0}; };
  for (const std::uint32_t t : island) {
    chart.smooth = chart.smooth || (t < scene.smooth.size() && scene.smooth[t] != 0);
    chart.area += 0.5 * length(scene.scaledNormal(t));
    const PlaneTriangle uv = unwrapped(scene, t);
    laid += std::abs(signedArea(uv));
    for (const Vec2d p : uv) box.add(placeOf(p));
  }
  const double scale = std::sqrt(chart.area / laid);
  chart.size = {std::max(scale * (box.hi.x - box.lo.x), minSize), std::max(scale * (box.hi.y - box.lo.y), minSize)};
  for (const std::uint32_t t : island) {
    const PlaneTriangle uv = unwrapped(scene, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d at = (placeOf(uv[k]) - box.lo) * scale;
      set.cornerUv[t][k] = {clampedInside(at.x, chart.size.x), clampedInside(at.y, chart.size.y)};
    }
  }
  return chart;
}

}  // namespace lucarne
