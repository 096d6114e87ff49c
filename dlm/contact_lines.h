// Where other geometry meets a chart side: what the texels of resolve.h must not mix across, and what light cannot
// reach.
//
// Both are looked for just above the chart's triangles, on the lit side, among opaque triangles that are not the
// chart's:
//   lines   where one that is steep (60° or more to the chart) cuts the plane a sixteenth of a texel up: the foot of a
//           wall, of a table leg. So high up, a wall that ends a little above its floor still stands on it.
//   covers  where one that is parallel (within 5°) lies nearer than a quarter of a texel: a rug, a skirting, the sole
//   of
//           a leg. What lies in the very plane is no cover: the two faces of a wall without thickness are there, and
//           the sole of a leg shows by its walls. As much light gets in under the edge of a cover as the edge keeps
//           from the surface before it, so on the whole the covered part has none.
// Slopes between (an eave, a ball on the floor) are neither: light thins out towards their foot, but has no edge there.
#pragma once

#include <vector>

#include "dlm/charts.h"
#include "dlm/plane_polygon.h"
#include "dlm/texel_layout.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

/// Texel coordinates.
struct ContactLine {
  Vec2d a, b;
};

struct SideLines {
  std::vector<ContactLine> lines;
  std::vector<PlanePolygon> covers;  // texel coordinates, counter-clockwise
  bool empty() const { return lines.empty() && covers.empty(); }
};

/// Height of the lines and of the highest cover over a chart, local units.
double contactHeight(const ChartLayout& layout);

/// Finds the contacts of chart sides. Time is proportional to the texels and triangles of the charts, and to the
/// triangles near them.
class ContactFinder {
 public:
  /// All must outlive this.
  ContactFinder(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const RayCaster& caster);

  SideLines find(std::uint32_t chart, bool back) const;

 private:
  class Piece;

  const Scene& scene_;
  const ChartSet& charts_;
  const TexelLayout& layout_;
  const RayCaster& caster_;
  std::vector<std::uint8_t> stops_;  // by triangle: no light goes through it
};

}  // namespace lucarne
