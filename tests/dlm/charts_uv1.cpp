// Charts of the scene's own unwrapping.
#include <gtest/gtest.h>

#include <functional>

#include "dlm/chart_uv1.h"
#include "dlm/texel_layout.h"
#include "tests/dlm/charts_invariants.h"

namespace lucarne::charts_uv1_test {
namespace {

using test::SceneBuilder;

/// A floor of two by two quads with corners of their own, unwrapped by `place(x, z)` of metres; `flat` in the middle.
Scene floorWith(const std::function<Vec2f(Vec3d)>& place) {
  SceneBuilder b;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      b.addQuad({2.0 * i, 0, 1.0 * (j + 1)}, {2.0 * (i + 1), 0, 1.0 * (j + 1)}, {2.0 * (i + 1), 0, 1.0 * j},
                {2.0 * i, 0, 1.0 * j});
  Scene scene = b.build();
  for (const Vec3f& p : scene.positions) scene.atlasUv.push_back(place(scene.frame.toWorld(Vec3d(p))));
  return scene;
}

Vec2f plain(Vec3d p) { return {static_cast<float>(0.1 + 0.2 * p.x), static_cast<float>(0.1 + 0.4 * p.z)}; }

ChartSet chartsOf(const Scene& scene) {
  ChartOptions options;
  options.useUv1 = true;
  return growCharts(scene, options);
}

TEST(Uv1Charts, AreTakenAsTheyAreWithTheShapeOfTheUnwrapping) {
  const Scene scene = floorWith(plain);  // 0.8 × 0.8 for 4 × 2 metres
  const ChartSet set = chartsOf(scene);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_EQ(set.uv1Charts, 1u);
  EXPECT_TRUE(set.uv1Refused.empty());
  const double metres = scene.frame.scale;
  EXPECT_NEAR(set.charts[0].size.x * metres, std::sqrt(8.0), 1e-5);  // a square of the floor's area
  EXPECT_NEAR(set.charts[0].size.y * metres, std::sqrt(8.0), 1e-5);
  EXPECT_NEAR(set.charts[0].area * metres * metres, 8, 1e-5);
  test::expectPartition(scene, set);
}

TEST(Uv1Charts, WithoutTheOptionChartsAreGrown) {
  const ChartSet set = growCharts(floorWith(plain));
  EXPECT_EQ(set.uv1Charts, 0u);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_NEAR(set.charts[0].size.x / set.charts[0].size.y, 2, 1e-5);
}

TEST(Uv1Charts, OnesApartInTheUnwrappingAreApart) {
  const Scene scene = floorWith([](Vec3d p) {
    return Vec2f{static_cast<float>(0.1 * p.x + (p.z > 1 ? 0.5 : 0.0)), static_cast<float>(0.1 + 0.2 * p.z)};
  });
  // The rows share the line z = 1 in space. Its corners have p.z = 1 in both rows: they are laid by the row's other end.
  Scene cut = scene;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
    for (const std::uint32_t v : cut.triangles[t].v)
      if (t >= 4) cut.atlasUv[v].x = static_cast<float>(0.1 * cut.frame.toWorld(Vec3d(cut.positions[v])).x) + 0.5f;
  const ChartSet set = chartsOf(cut);
  EXPECT_EQ(set.charts.size(), 2u);
  EXPECT_EQ(set.uv1Charts, 2u);
}

TEST(Uv1Charts, MirroredOnesAreTurnedOver) {
  const ChartSet set = chartsOf(floorWith([](Vec3d p) { return Vec2f{0.9f - plain(p).x, plain(p).y}; }));
  EXPECT_EQ(set.uv1Charts, 1u);
  for (std::uint32_t t = 0; t < 8; ++t) {
    const auto& c = set.cornerUv[t];
    const Vec2f a = c[1] - c[0], b = c[2] - c[0];
    EXPECT_GT(a.x * b.y - a.y * b.x, 0);
  }
}

TEST(Uv1Charts, ThatOverlapLeaveTheSquareOrHaveNoAreaAreRefusedWithTheReason) {
  const auto refusal = [](const std::function<Vec2f(Vec3d)>& place) {
    const ChartSet set = chartsOf(floorWith(place));
    EXPECT_EQ(set.uv1Charts, 0u);
    EXPECT_EQ(set.charts.size(), 1u) << "grown instead";
    return set.uv1Refused.size() == 1 ? set.uv1Refused[0] : std::string();
  };
  EXPECT_NE(refusal([](Vec3d p) { return Vec2f{plain(p).x + 0.5f, plain(p).y}; }).find("leaves 0..1 at (1.4"),
            std::string::npos);
  EXPECT_NE(refusal([](Vec3d p) { return Vec2f{plain(p).x, 0.1f + 0.3f * static_cast<float>(std::abs(p.z - 1))}; })
                .find("overlaps itself"),
            std::string::npos);
  EXPECT_NE(refusal([](Vec3d p) { return Vec2f{plain(p).x, 0.5f}; }).find("without area"), std::string::npos);
  EXPECT_NE(refusal([](Vec3d p) { return Vec2f{p.x > 1 ? NAN : 0.f, 0.5f}; }).find("leaves 0..1"), std::string::npos);
}

TEST(Uv1Charts, OfAnUnwrappedBoxDoNotReachAroundItsEdges) {
  SceneBuilder b;
  b.addQuad({0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0});
  b.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});  // a wall at its far edge
  Scene scene = b.build();
  for (const Vec3f& p : scene.positions) {
    const Vec3d m = scene.frame.toWorld(Vec3d(p));
    scene.atlasUv.push_back({static_cast<float>(0.1 + 0.3 * m.x), static_cast<float>(0.5 + 0.3 * (m.y - m.z))});
  }
  const ChartSet set = chartsOf(scene);
  EXPECT_EQ(set.uv1Charts, 2u) << "one unwrapped strip with a crease: " << (set.uv1Refused.empty() ? "" : set.uv1Refused[0]);
}

TEST(Uv1Charts, LayOutCoversTheirSurface) {
  const Scene scene = floorWith(plain);
  const ChartSet set = chartsOf(scene);
  const TexelLayout layout = layOutTexels(scene, set, {});
  double sum = 0;
  for (const double a : layout.area) sum += a;
  EXPECT_NEAR(sum / set.charts[0].area, 1, 1e-6);
}

}  // namespace
}  // namespace lucarne::charts_uv1_test
