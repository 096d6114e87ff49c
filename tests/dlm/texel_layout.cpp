#include "dlm/texel_layout.h"

#include <limits>
#include <numeric>

#include "base/error.h"
#include "dlm/texel_layout_coverage.h"
#include "tests/dlm/charts_invariants.h"

namespace lucarne::test::texel_layout_test {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

void expectAreasAddUp(const ChartSet& set, const TexelLayout& layout) {
  std::uint64_t next = 0;
  ASSERT_EQ(layout.charts.size(), set.charts.size());
  for (std::size_t c = 0; c < set.charts.size(); ++c) {
    const ChartLayout& chart = layout.charts[c];
    ASSERT_EQ(chart.firstTexel, next);
    next += chart.texelCount();
    double area = 0;
    for (std::uint64_t t = chart.firstTexel; t < next; ++t) {
      ASSERT_GE(layout.area[t], 0);
      area += layout.area[t];
    }
    ASSERT_NEAR(area, set.charts[c].area, 1e-9 * set.charts[c].area) << c;
  }
  ASSERT_EQ(next, layout.texelCount);
  ASSERT_EQ(next, layout.area.size());
}

TEST(TexelLayout, OfABoxCoversEveryTexelWholly) {
  SceneBuilder builder;
  builder.addBox({0, 0, 0}, {3, 2, 1});
  const Scene scene = builder.build();
  const ChartSet set = growCharts(scene);
  const TexelLayout layout = layOutTexels(scene, set, {8, 1'000'000});
  expectAreasAddUp(set, layout);
  EXPECT_FALSE(layout.thinned);
  EXPECT_EQ(layout.texelsPerMetre, 8);
  EXPECT_EQ(layout.texelCount, 2u * 64 * (3 * 2 + 2 * 1 + 3 * 1));
  const double texel = 1.0 / 64 / (scene.frame.scale * scene.frame.scale);
  for (const double area : layout.area) EXPECT_NEAR(area, texel, 1e-6 * texel);
}

TEST(TexelLayout, TexelsAreStretchedToFitTheChart) {
  SceneBuilder builder;
  builder.addQuad({0, 0, 0}, {1.3, 0, 0}, {1.3, 0.7, 0}, {0, 0.7, 0});
  const Scene scene = builder.build();
  const ChartSet set = growCharts(scene);
  const TexelLayout layout = layOutTexels(scene, set, {10, 1000});
  ASSERT_EQ(layout.charts.size(), 1u);
  const ChartLayout& chart = layout.charts[0];
  EXPECT_EQ(chart.width, 13);
  EXPECT_EQ(chart.height, 7);
  EXPECT_DOUBLE_EQ(set.charts[0].size.x * chart.texelsPerLocal.x, 13);
  EXPECT_DOUBLE_EQ(set.charts[0].size.y * chart.texelsPerLocal.y, 7);
}

TEST(TexelLayout, AChartSmallerThanATexelHasOne) {
  SceneBuilder builder;
  builder.addTriangle({0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0});
  builder.addBox({10, 10, 10}, {10.02, 10.02, 10.02});
  const Scene scene = builder.build();
  const ChartSet set = growCharts(scene);
  const TexelLayout layout = layOutTexels(scene, set, {1, 100});
  expectAreasAddUp(set, layout);
  EXPECT_EQ(layout.texelCount, set.charts.size());
}

TEST(TexelLayout, AreasAddUpOnCurvedCharts) {
  for (const double density : {0.3, 5.0, 61.7, 400.0}) {
    const Scene scene = sphere(48, 24);
    const ChartSet set = growCharts(scene);
    const TexelLayout layout = layOutTexels(scene, set, {density, 8'000'000});
    expectAreasAddUp(set, layout);
    EXPECT_NEAR(sum(layout.area) * scene.frame.scale * scene.frame.scale, 4 * 3.14159265358979, 0.15);
  }
}

TEST(TexelLayout, IsThinnedToTheBudgetAndFillsIt) {
  SceneBuilder builder;
  builder.addBox({0, 0, 0}, {3000, 2000, 1000});
  const Scene scene = builder.build();
  const ChartSet set = growCharts(scene);
  const TexelLayout layout = layOutTexels(scene, set, {16, 500'000});
  expectAreasAddUp(set, layout);
  EXPECT_TRUE(layout.thinned);
  EXPECT_LE(layout.texelCount, 500'000u);
  EXPECT_GE(layout.texelCount, 480'000u);
  const TexelLayout again = layOutTexels(scene, set, {layout.texelsPerMetre, 500'000});
  EXPECT_FALSE(again.thinned);
  EXPECT_EQ(again.texelCount, layout.texelCount);
}

TEST(TexelLayout, BudgetOfOneTexelAChartIsMetExactlyAndLessIsRefused) {
  SceneBuilder builder;
  builder.addBox({0, 0, 0}, {3, 2, 1});
  const Scene scene = builder.build();
  const ChartSet set = growCharts(scene);
  EXPECT_EQ(layOutTexels(scene, set, {16, 6}).texelCount, 6u);
  try {
    layOutTexels(scene, set, {16, 5});
    FAIL() << "a budget below one texel a chart was met";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::outOfResource);
  }
}

TEST(TexelLayout, NoChartIsWiderThanAPageCanBe) {
  SceneBuilder builder;
  builder.addQuad({0, 0, 0}, {10000, 0, 0}, {10000, 0, -0.1}, {0, 0, -0.1});
  const Scene scene = builder.build();
  const TexelLayout layout = layOutTexels(scene, growCharts(scene), {16, 4'000'000});
  EXPECT_TRUE(layout.thinned);
  EXPECT_LE(layout.charts[0].width, 16000);
  EXPECT_GE(layout.charts[0].width, 15900);
}

TEST(TexelLayout, AnyDensityIsThinned) {
  SceneBuilder builder;
  builder.addBox({0, 0, 0}, {3, 2, 1});
  const Scene scene = builder.build();
  for (const double density : {1e-300, 1e12, 1e300, std::numeric_limits<double>::infinity()}) {
    const TexelLayout layout = layOutTexels(scene, growCharts(scene), {density, 10'000});
    EXPECT_EQ(layout.thinned, density > 1);
    EXPECT_LE(layout.texelCount, 10'000u);
  }
}

TEST(TexelLayout, OfASceneWithoutChartsIsEmpty) {
  const TexelLayout layout = layOutTexels(Scene{}, ChartSet{}, {});
  EXPECT_EQ(layout.texelCount, 0u);
  EXPECT_FALSE(layout.thinned);
}

/// Covered area of each texel, row by row.
std::vector<double> coverage(int width, int height, const std::array<Vec2d, 3>& triangle) {
  std::vector<double> area(static_cast<std::size_t>(width * height), 0.0);
  TexelCoverage texels(width, height);
  for (const CoveredRun& run : texels.of(triangle)) {
    EXPECT_GE(run.x, 0);
    EXPECT_LE(run.x + run.count, width);
    EXPECT_GE(run.y, 0);
    EXPECT_LT(run.y, height);
    for (int i = 0; i < run.count; ++i) area[static_cast<std::size_t>(run.y * width + run.x + i)] += run.area;
  }
  return area;
}

TEST(TexelCoverage, AgreesWithPointSampling) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0, 1);
  const int width = 9, height = 6, grid = 40;
  for (int trial = 0; trial < 60; ++trial) {
    std::array<Vec2d, 3> corner;
    for (Vec2d& p : corner) p = {place(random) * width, place(random) * height};
    UvTriangle triangle{corner[0], corner[1], corner[2]};
    if (triangle.area() < 0) std::swap(triangle.b, triangle.c);
    const std::vector<double> area = coverage(width, height, corner);
    EXPECT_NEAR(sum(area), triangle.area(), 1e-12 * width * height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        int inside = 0;
        for (int s = 0; s < grid * grid; ++s) {
          inside += triangle.depth({x + (s % grid + 0.5) / grid, y + (s / grid + 0.5) / grid}) > 0;
        }
        EXPECT_NEAR(area[static_cast<std::size_t>(y * width + x)], double(inside) / (grid * grid), 3.0 / grid);
      }
    }
  }
}

TEST(TexelCoverage, OfTwoHalvesIsTheWholeInEveryTexel) {
  const std::vector<double> a = coverage(7, 5, {Vec2d{0, 0}, Vec2d{7, 0}, Vec2d{7, 5}});
  const std::vector<double> b = coverage(7, 5, {Vec2d{0, 0}, Vec2d{7, 5}, Vec2d{0, 5}});
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i] + b[i], 1, 1e-14);
}

TEST(TexelCoverage, OnTexelLinesIsExactAndNothingBeyond) {
  const std::vector<double> a = coverage(4, 4, {Vec2d{1, 1}, Vec2d{3, 1}, Vec2d{1, 3}});
  const std::vector<double> expected{0, 0, 0, 0, 0, 1, 0.5, 0, 0, 0.5, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(a, expected);
}

TEST(TexelCoverage, OfSliversAcrossThousandsOfTexels) {
  for (const Vec2d end : {Vec2d{12000, 9000}, Vec2d{12000, 0.001}, Vec2d{0.001, 9000}, Vec2d{12000, 8999.5}}) {
    TexelCoverage texels(12000, 9000);
    const Vec2d across{-end.y * 1e-9, end.x * 1e-9};
    const std::array<Vec2d, 3> corner{Vec2d{0, 0}, end,
                                      Vec2d{end.x * 0.5 + std::abs(across.x), end.y * 0.5 + across.y}};
    UvTriangle triangle{corner[0], corner[1], corner[2]};
    double total = 0;
    for (const CoveredRun& run : texels.of(corner)) total += run.area * run.count;
    // Its width is 1e-5 texels: known to the rounding of its corners, 1e-12, and of thousands of cuts.
    EXPECT_NEAR(total, std::abs(triangle.area()), 1e-3 * std::abs(triangle.area()));
  }
}

TEST(TexelCoverage, OfALineOrAPointIsNothing) {
  TexelCoverage texels(5, 5);
  EXPECT_TRUE(texels.of({Vec2d{1, 1}, Vec2d{1, 1}, Vec2d{1, 1}}).empty());
  EXPECT_TRUE(texels.of({Vec2d{0, 2}, Vec2d{5, 2}, Vec2d{3, 2}}).empty());
  EXPECT_TRUE(texels.of({Vec2d{5, 0}, Vec2d{5, 5}, Vec2d{5, 3}}).empty());
}

TEST(TexelLayout, ChartsThatAskForADensityOfTheirOwnGetItAlsoUnderABudget) {
  SceneBuilder builder;
  builder.addQuad({0, 0, 2}, {2, 0, 2}, {2, 0, 0}, {0, 0, 0});
  builder.addQuad({5, 0, 2}, {7, 0, 2}, {7, 0, 0}, {5, 0, 0});
  Scene scene = builder.build();
  scene.instances = {{0, 0, 0, 0, 2, 0, 4, 0}, {1, 1, 0, 2, 2, 4, 4, 40}};
  const ChartSet set = growCharts(scene);
  ASSERT_EQ(set.charts.size(), 2u);
  const TexelLayout layout = layOutTexels(scene, set, {10, 1'000'000});
  EXPECT_EQ(layout.charts[0].width, 20);
  EXPECT_EQ(layout.charts[1].width, 80);
  expectAreasAddUp(set, layout);
  const TexelLayout thin = layOutTexels(scene, set, {10, 1'000});
  EXPECT_TRUE(thin.thinned);
  EXPECT_LE(thin.texelCount, 1000u);
  EXPECT_NEAR(static_cast<double>(thin.charts[1].width) / thin.charts[0].width, 4, 0.6);
}

}  // namespace
}  // namespace lucarne::test::texel_layout_test
