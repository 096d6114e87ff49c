// A sphere of flat facets with interpolated normals, for SceneBuilder.
#pragma once

#include "tests/support/scene_builder.h"

namespace lucarne::test {

/// A cube blown up: six faces of cells × cells quads, fronts outward. smoothen() makes its normals the sphere's.
inline void addSphere(SceneBuilder& s, Vec3d center, double radius, std::uint32_t material, int cells) {
  const auto point = [&](int face, int i, int j) {
    const double a = 2.0 * i / cells - 1, b = 2.0 * j / cells - 1;
    const Vec3d cube[6] = {{1, a, b}, {-1, b, a}, {b, 1, a}, {a, -1, b}, {a, b, 1}, {b, a, -1}};
    return center + normalize(cube[face]) * radius;
  };
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j)
        s.addQuad(point(face, i, j), point(face, i + 1, j), point(face, i + 1, j + 1), point(face, i, j + 1), material);
}

/// Normals away from `center` (metres) for all triangles of a material.
inline void smoothen(Scene& scene, std::uint32_t material, Vec3d center) {
  const Vec3d local = scene.frame.toLocal(center);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (scene.triangles[t].material != material) continue;
    scene.smooth[t] = 1;
    for (const std::uint32_t v : scene.triangles[t].v)
      scene.normals[v] = Vec3f(normalize(Vec3d(scene.positions[v]) - local));
  }
}

/// Largest angle between a facet and its normals: sine.
inline double largestFacetSine(const Scene& scene, std::uint32_t material) {
  double largest = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (const std::uint32_t v : scene.triangles[t].v)
      if (scene.triangles[t].material == material)
        largest = std::max(largest, length(cross(normalize(scene.scaledNormal(t)), Vec3d(scene.normals[v]))));
  return largest;
}

}  // namespace lucarne::test
