// The invariants of charts, texels and pages on real scenes, and bounds on what they cost.
#include <filesystem>
#include <numeric>

#include "dlm/pack.h"
#include "dlm/texel_layout.h"
#include "tests/dlm/charts_invariants.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne::test::charts_scenes_test {
namespace {

struct RealScene {
  const char* path;
  double trianglesPerChart;  // at least
  double covered;            // least share of the charts' rectangles that is surface
};

void PrintTo(const RealScene& scene, std::ostream* out) { *out << scene.path; }

class ChartsOfScenes : public testing::TestWithParam<RealScene> {};

TEST_P(ChartsOfScenes, AreFewAndKeepEveryInvariant) {
  const std::filesystem::path path = std::filesystem::path(LUCARNE_SOURCE_DIR "/../shared/assets") / GetParam().path;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const Scene scene = readGltf(path.string());
  const ChartSet set = growCharts(scene);
  expectPartition(scene, set);
  expectPlanes(scene, set);
  expectNoOverlap(set, 4000);
  EXPECT_GE(static_cast<double>(scene.triangles.size()) / static_cast<double>(set.charts.size()),
            GetParam().trianglesPerChart);

  double area = 0, rectangles = 0;
  for (const Chart& chart : set.charts) {
    area += chart.area;
    rectangles += chart.size.x * chart.size.y;
  }
  EXPECT_GE(area / rectangles, GetParam().covered);

  const TexelLayout layout = layOutTexels(scene, set, {});
  EXPECT_LE(layout.texelCount, LayoutOptions{}.texelBudget);
  const double laidOut = std::accumulate(layout.area.begin(), layout.area.end(), 0.0);
  EXPECT_LE(laidOut, area * (1 + 1e-9));
  const bool holes = std::any_of(scene.materials.begin(), scene.materials.end(), [](auto& m) { return m.hasAlpha(); });
  if (!holes) {
    EXPECT_GE(laidOut, area * (1 - 1e-9));
  }
  std::vector<RectSize> sizes;
  for (const ChartLayout& chart : layout.charts) sizes.push_back({chart.width, chart.height});
  const Packing packing = packRectangles(sizes, {});
  EXPECT_LE(std::max(packing.pageWidth, packing.pageHeight), PackOptions{}.maxPageSize);
}

INSTANTIATE_TEST_SUITE_P(Real, ChartsOfScenes,
                         testing::Values(RealScene{"scenes/country_kitchen.glb", 20, 0.7},
                                         RealScene{"scenes/lux_kitchen.glb", 7, 0.9},
                                         RealScene{"scenes/hotel_room.glb", 20, 0.65},
                                         RealScene{"models/sheen_chair.glb", 40, 0.4},
                                         RealScene{"models/bunny.glb", 40, 0.5}),
                         [](const auto& scene) { return std::filesystem::path(scene.param.path).stem().string(); });

}  // namespace
}  // namespace lucarne::test::charts_scenes_test
