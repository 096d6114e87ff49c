// Curved surfaces for scenes in memory: grids of quads with shared vertices, appended to a scene whose local frame is
// already fixed.
#pragma once

#include "base/math.h"
#include "tests/support/scene_builder.h"

namespace lucarne::bench {

inline Vec2d onCircle(double turns) { return {cosPi(2 * turns), sinPi(2 * turns)}; }

/// `point(u, v)` in metres for u, v in [0, 1], cut into nu × nv quads. Fronts look along ∂p/∂u × ∂p/∂v. `point` may
/// close on itself; triangles without area (at poles) are left out.
template <class Point>
void addGrid(Scene& scene, int nu, int nv, std::uint32_t material, bool smooth, Point&& point) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) {
      const double u = static_cast<double>(i) / nu, v = static_cast<double>(j) / nv;
      scene.positions.push_back(localPosition(scene.frame, point(u, v)));
      scene.uv0.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
  }
  const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3f p = scene.positions[a], q = scene.positions[b], r = scene.positions[c];
    if (length(q - p) < 1e-6f || length(r - q) < 1e-6f || length(p - r) < 1e-6f) return;
    scene.triangles.push_back({{a, b, c}, material});
    scene.smooth.push_back(smooth);
  };
  const auto row = static_cast<std::uint32_t>(nu + 1);
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(nv); ++j) {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(nu); ++i) {
      const std::uint32_t a = first + j * row + i, b = a + 1, d = a + row, c = d + 1;
      addTriangle(a, b, c);
      addTriangle(a, c, d);
    }
  }
}

/// Fills in what grids leave open: vertex normals (means over the triangles, weighted by area), source vertices, the
/// one instance, and the marks of triangles that are no surface of their own, which must be as many as the triangles.
inline void finishGrids(Scene& scene) {
  std::vector<Vec3d> sum(scene.positions.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (const std::uint32_t v : scene.triangles[t].v) sum[v] += scene.scaledNormal(t);
  scene.normals.clear();
  for (const Vec3d& n : sum) scene.normals.emplace_back(normalize(n));
  const auto vertices = static_cast<std::uint32_t>(scene.positions.size());
  for (auto i = static_cast<std::uint32_t>(scene.sourceVertex.size()); i < vertices; ++i)
    scene.sourceVertex.push_back(i);
  scene.instances = {{0, 0, 0, 0, static_cast<std::uint32_t>(scene.triangles.size()), 0, vertices}};
  markSkipped(scene);
}

}  // namespace lucarne::bench
