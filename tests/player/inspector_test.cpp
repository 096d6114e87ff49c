#include "player/inspector.h"

#include <gtest/gtest.h>

#include <numbers>

#include "player/light_plot.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::inspector_test {
namespace {

test::BakedScene plate(int directions, const test::IncidentRadiance& light) {
  test::BakedSceneBuilder b(directions, light);
  Material m;
  m.name = "plate";
  b.addQuad({-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}, b.addMaterial(m), 8, 8);
  b.addCamera({0, 0, 5}, {0, 0, 0}, 1.0);
  return b.build();
}

TEST(Inspector, TellsThePlaceUnderThePixel) {
  const test::BakedScene baked = plate(14, test::constantRadiance({1.f, 2.f, 3.f}));
  const Inspector inspector(baked.scene, baked.maps);
  const Camera& camera = baked.scene.cameras.at(0);
  // 3 m before the eye the picture is 2 · 3 · tan(0.5) m high.
  const double height = 6 * std::tan(0.5), aspect = 1.5;
  for (const Vec2d at : {Vec2d{0, 0}, Vec2d{0.6, -0.4}, Vec2d{-0.9, 0.8}}) {
    const auto found = inspector.inspect(camera, 0.5 + at.x / (height * aspect), 0.5 - at.y / height, aspect);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->position.x, at.x, 1e-4);
    EXPECT_NEAR(found->position.y, at.y, 1e-4);
    EXPECT_NEAR(found->position.z, 2, 1e-4);
    EXPECT_NEAR(found->normal.z, 1, 1e-6);
    EXPECT_EQ(found->material, "plate");
    ASSERT_TRUE(found->answer.onSurface);
    EXPECT_NEAR(found->answer.irradiance.y, 2 * std::numbers::pi, 1e-4);
  }
  EXPECT_FALSE(inspector.inspect(camera, 0.01, 0.5, aspect));
}

TEST(LightPlot, SpotsOfConstantLightHaveItsRadianceAndCoverTheDiscOnce) {
  const test::BakedScene baked = plate(64, test::constantRadiance({1.f, 2.f, 3.f}));
  const Inspector inspector(baked.scene, baked.maps);
  const auto found = inspector.inspect(baked.scene.cameras.at(0), 0.5, 0.5, 1);
  ASSERT_TRUE(found);
  const auto spots = lightSpots(found->answer, found->normal);
  double area = 0;
  for (const LightSpot& s : spots) {
    EXPECT_NEAR(s.radiance.z, 3, 1e-3);
    EXPECT_LE(s.centre.x * s.centre.x + s.centre.y * s.centre.y, 1 + 1e-9);
    area += s.radius * s.radius;
  }
  EXPECT_NEAR(area, 1, 1e-3);
}

TEST(LightPlot, UpInTheDiscIsUpInTheSceneAndRightIsRight) {
  ProbeAnswer answer;
  answer.onSurface = true;
  answer.directions = {{0, normalize(Vec3d{0, 1, 1}), Rgbd(1.), 1, 0.5},
                       {1, normalize(Vec3d{1, 0, 1}), Rgbd(1.), 1, 0.5}};
  const auto wall = lightSpots(answer, {0, 0, 1});
  ASSERT_EQ(wall.size(), 2u);
  EXPECT_GT(wall[0].centre.y, 0.5);
  EXPECT_NEAR(wall[0].centre.x, 0, 1e-12);
  EXPECT_GT(wall[1].centre.x, 0.5);
  const auto floor = lightSpots(answer, {0, 1, 0});  // seen from above: −z is up, +x right
  EXPECT_LT(floor[0].centre.y, -0.5);
  EXPECT_GT(floor[1].centre.x, 0.5);
}

}  // namespace
}  // namespace lucarne::inspector_test
