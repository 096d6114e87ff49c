#include "dlm/texel_layout.h"

#include <string>

#include "base/error.h"
#include "dlm/texel_alpha.h"
#include "dlm/texel_layout_coverage.h"

namespace lucarne {
namespace {

constexpr double kMaxSide = 16000;  // texels along a chart: what one page of a light map can hold

double texelsAlong(double size, double texelsPerLocal) { return std::max(1.0, std::ceil(size * texelsPerLocal)); }

/// Charts, and for each how much denser than the others it is to be.
struct WeightedCharts {
  const ChartSet& set;
  std::vector<double> weight;
  Vec2d texels(std::size_t chart, double texelsPerLocal) const {
    const Vec2d size = set.charts[chart].size;
    const double d = texelsPerLocal * weight[chart];
    return {texelsAlong(size.x, d), texelsAlong(size.y, d)};
  }
};

/// Of a chart that several instances share, the largest density that any of them asks for.
WeightedCharts weigh(const Scene& scene, const ChartSet& set, double texelsPerMetre) {
  WeightedCharts charts{set, std::vector<double>(set.charts.size(), 0)};
  for (const PrimitiveInstance& instance : scene.instances) {
    if (!(instance.texelsPerMetre > 0)) continue;
    for (std::uint32_t t = instance.firstTriangle; t < instance.firstTriangle + instance.triangleCount; ++t) {
      if (set.chartOfTriangle[t] == kNone) continue;
      double& weight = charts.weight[set.chartOfTriangle[t]];
      weight = std::max(weight, instance.texelsPerMetre / texelsPerMetre);
    }
  }
  for (double& weight : charts.weight)
    if (weight == 0) weight = 1;
  return charts;
}

/// In floating point, so that no scene overflows it.
bool fits(const WeightedCharts& charts, double texelsPerLocal, double budget) {
  double sum = 0;
  for (std::size_t c = 0; c < charts.weight.size(); ++c) {
    const Vec2d texels = charts.texels(c, texelsPerLocal);
    if (std::max(texels.x, texels.y) > kMaxSide) return false;
    sum += texels.x * texels.y;
  }
  return sum <= budget;
}

/// The largest density up to `wanted` that fits, to one part in 2^20.
double fittingDensity(const WeightedCharts& charts, double wanted, double budget) {
  if (fits(charts, wanted, budget)) return wanted;
  double low = wanted / 2, high = wanted;
  while (!fits(charts, low, budget)) {  // ends: a density low enough gives each chart one texel
    high = low;
    low /= 2;
  }
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(charts, middle, budget) ? low : high) = middle;
  }
  return low;
}

ChartLayout chartLayout(const WeightedCharts& charts, std::size_t chart, double texelsPerLocal,
                        std::uint64_t firstTexel) {
  const Vec2d texels = charts.texels(chart, texelsPerLocal), size = charts.set.charts[chart].size;
  ChartLayout layout;
  layout.width = static_cast<int>(texels.x);
  layout.height = static_cast<int>(texels.y);
  layout.firstTexel = firstTexel;
  layout.texelsPerLocal = {layout.width / size.x, layout.height / size.y};
  return layout;
}

/// Spreads each triangle's surface over the texels in proportion to what they hold of its projection: the sum is the
/// chart's area whatever rounding did to the corners. Where there are holes, what is there for light counts.
void coverChart(const Scene& scene, const ChartSet& set, const Chart& chart, const ChartLayout& layout,
                const TexelAlpha& alpha, std::vector<double>& area) {
  TexelCoverage coverage(layout.width, layout.height);
  const auto index = [&layout](int x, int y) {
    return layout.firstTexel + static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(layout.width) +
           static_cast<std::uint64_t>(x);
  };
  for (const std::uint32_t t : chart.triangles) {
    std::array<Vec2d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = set.cornerUv[t][k];
      corner[k] = {uv.x * layout.texelsPerLocal.x, uv.y * layout.texelsPerLocal.y};
    }
    const double surface = 0.5 * length(scene.scaledNormal(t));
    double projected = 0;
    const std::vector<CoveredRun>& runs = coverage.of(corner);
    for (const CoveredRun& run : runs) projected += run.count * run.area;
    if (!(projected > 0)) {  // rounding left a line: all of it is where its middle is
      const Vec2d middle = (corner[0] + corner[1] + corner[2]) * (1.0 / 3);
      const TexelIndex texel = texelAt(layout, {static_cast<float>(middle.x), static_cast<float>(middle.y)});
      area[index(texel.x, texel.y)] += surface * (alpha.varies(t) ? alpha.mean(t, corner, texel.x, texel.y) : 1);
      continue;
    }
    const double scale = surface / projected;
    for (const CoveredRun& run : runs) {
      const std::uint64_t first = index(run.x, run.y);
      for (int i = 0; i < run.count; ++i) {
        const double there = alpha.varies(t) ? alpha.mean(t, corner, run.x + i, run.y) : 1;
        area[first + static_cast<std::uint64_t>(i)] += run.area * scale * there;
      }
    }
  }
}

}  // namespace

TexelLayout layOutTexels(const Scene& scene, const ChartSet& set, const LayoutOptions& options) {
  if (set.charts.size() > options.texelBudget) {
    throw Error(ExitCode::outOfResource, "the scene needs at least one texel for each of its " +
                                             std::to_string(set.charts.size()) + " charts, more than the budget of " +
                                             std::to_string(options.texelBudget) + " texels: raise the budget");
  }
  TexelLayout layout;
  const double wanted = std::min(options.texelsPerMetre * scene.frame.scale, 1e30);  // infinity cannot be halved
  const WeightedCharts charts = weigh(scene, set, options.texelsPerMetre);
  const double used = fittingDensity(charts, wanted, static_cast<double>(options.texelBudget));
  layout.thinned = used < wanted;
  layout.texelsPerMetre = layout.thinned ? used / scene.frame.scale : options.texelsPerMetre;
  layout.charts.reserve(set.charts.size());
  for (std::size_t c = 0; c < set.charts.size(); ++c) {
    layout.charts.push_back(chartLayout(charts, c, used, layout.texelCount));
    layout.texelCount += layout.charts.back().texelCount();
  }
  if (layout.texelCount > options.texelLimit) {
    throw Error(ExitCode::outOfResource, "the layout has " + std::to_string(layout.texelCount) + " texels, more than " +
                                             std::to_string(options.texelLimit));
  }
  layout.area.assign(layout.texelCount, 0.0);
  const TexelAlpha alpha(scene);
  for (std::size_t i = 0; i < set.charts.size(); ++i) {
    coverChart(scene, set, set.charts[i], layout.charts[i], alpha, layout.area);
  }
  return layout;
}

}  // namespace lucarne
