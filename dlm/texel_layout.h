// Texel layout: how many texels each chart gets, and how much surface lies inside each texel.
//
// A chart of size (su, sv) local units gets width = max(1, ceil(su · d)) by height = max(1, ceil(sv · d)) texels, d the
// density, and its texels are stretched so that they fit exactly: texel coordinates are uv · (width/su, height/sv).
// Instances that ask for a density of their own (PrimitiveInstance::texelsPerMetre) get it in place of d.
// The density is lowered, too, until no chart is longer than 16000 texels, so that it fits into a page.
// A rectangle is then covered by whole texels only. A texel owns [x, x+1) × [y, y+1), the last ones also the far edge.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/charts.h"

namespace lucarne {

struct LayoutOptions {
  double texelsPerMetre = 16;
  std::uint64_t texelBudget = 4'000'000;  // over all charts (one side); a denser layout is thinned to fit
  std::uint64_t texelLimit = ~std::uint64_t{0};  // a layout with more is an Error(outOfResource), before it takes memory
};

struct ChartLayout {
  int width = 1, height = 1;
  std::uint64_t firstTexel = 0;  // texels of all charts are numbered through, row by row
  Vec2d texelsPerLocal{};        // texel coordinates = chart uv · texelsPerLocal
  std::uint64_t texelCount() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

struct TexelLayout {
  double texelsPerMetre = 0;  // as used, after the budget
  bool thinned = false;       // the budget lowered it
  std::vector<ChartLayout> charts;
  std::uint64_t texelCount = 0;
  // [texel] surface inside that is there for light (alpha included), local units²; without holes they sum to the charts'
  // areas. 0: not covered.
  std::vector<double> area;
};

/// Throws Error(outOfResource) when even one texel a chart is over the budget.
TexelLayout layOutTexels(const Scene& scene, const ChartSet& charts, const LayoutOptions& options);

/// Texel (x, y) of a chart that holds the point at texel coordinates `st`; clamped into the rectangle.
struct TexelIndex {
  int x, y;
};
inline TexelIndex texelAt(const ChartLayout& chart, Vec2f st) {
  const int x = static_cast<int>(st.x), y = static_cast<int>(st.y);
  return {std::clamp(x, 0, chart.width - 1), std::clamp(y, 0, chart.height - 1)};
}

}  // namespace lucarne
