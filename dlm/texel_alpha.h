// How much of the surface inside a texel is there for light: the mean alpha of materials with holes.
#pragma once

#include <array>
#include <vector>

#include "tracer/optics/texture.h"
#include "tracer/scene/scene.h"

namespace lucarne {

class TexelAlpha {
 public:
  /// `scene` must outlive this.
  explicit TexelAlpha(const Scene& scene);

  /// False where alpha is 1 everywhere on the triangle.
  bool varies(std::uint32_t triangle) const { return scene_.materials[scene_.triangles[triangle].material].hasAlpha(); }
  /// Mean coverage of a triangle inside texel (x, y), its corners in texel coordinates. By samples on a grid that is four
  /// times as fine as the texture, up to 16 × 16.
  double mean(std::uint32_t triangle, const std::array<Vec2d, 3>& corner, int x, int y) const;

 private:
  int gridSize(std::uint32_t triangle, const std::array<Vec2d, 3>& corner) const;
  double at(std::uint32_t triangle, Vec2d barycentric) const;
  const std::vector<Vec2f>& uvOf(const TextureReader& texture) const {
    return texture.uvSet() == 0 ? scene_.uv0 : scene_.uv1;
  }

  const Scene& scene_;
  std::vector<TextureReader> readers_;  // of the base colour, by material
};

}  // namespace lucarne
