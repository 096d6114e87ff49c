// Where the texels of finished light maps lie in the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "dlm/dlm_reader.h"

namespace lucarne {

/// Area inside each texel of each chart, m², from the triangles' places in the atlas. Front and back share it.
class TexelAreas {
 public:
  explicit TexelAreas(const Dlm& dlm);
  /// Of texel `t` of a chart, row by row; 0: no surface.
  double of(std::uint32_t chart, std::uint64_t t) const { return area_[first_[chart] + t]; }

 private:
  std::vector<std::uint64_t> first_;
  std::vector<double> area_;
};

/// The point of the chart's surface (metres) that lies nearest to a place of its rectangle, in texels. Looks at every
/// triangle of the scene.
Vec3d surfaceAt(const Dlm& dlm, std::uint32_t chart, Vec2d st);

/// Both hold the same triangles in the same rectangles, so that a texel of one is that texel of the other.
bool sameLayout(const Dlm& a, const Dlm& b);

}  // namespace lucarne
