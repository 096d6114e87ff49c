// The surface inside the texels of a piece of a chart, texel by texel, to draw places from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dlm/charts.h"
#include "dlm/texel_layout.h"

namespace lucarne {

/// Texels [x, x + width) × [y, y + height) of a chart.
struct TexelTile {
  std::uint32_t chart;
  int x, y, width, height;
};

/// A triangle of surface inside one texel.
struct SurfacePiece {
  std::uint32_t triangle;
  std::array<Vec2f, 3> b;  // its corners, in barycentrics of `triangle`
  double upTo;             // surface of the texel's pieces up to this one, with it; local units²
};

/// A place on a triangle.
struct TexelPlace {
  std::uint32_t triangle;
  Vec2f b;
};

class TexelSurface {
 public:
  /// Clips the chart's triangles against the tile's texels (Sutherland and Hodgman 1974). Surface is spread as the
  /// layout's areas are, but holes count as surface here.
  TexelSurface(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const TexelTile& tile);

  /// Surface inside texel `t` of the tile, numbered row by row; local units², 0: none.
  double area(std::size_t t) const { return first_[t] == first_[t + 1] ? 0 : pieces_[first_[t + 1] - 1].upTo; }
  /// A place uniform over the surface of a texel that has some; u in [0, 1)³.
  TexelPlace sample(std::size_t t, Vec3f u) const;

 private:
  std::vector<SurfacePiece> pieces_;  // by texel
  std::vector<std::size_t> first_;    // of each texel, and one past the last
};

}  // namespace lucarne
