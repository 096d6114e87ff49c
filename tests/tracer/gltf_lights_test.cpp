#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tracer/gltf_maker.h"

namespace lucarne::gltf_lights_test {
namespace {

using test::GltfMaker;
using test::squareMaker;
using ::testing::Contains;
using ::testing::HasSubstr;

GltfMaker withLight(const Json& light, Json node) {
  GltfMaker maker = squareMaker();
  maker.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
  node["extensions"]["KHR_lights_punctual"]["light"] = 0;
  maker.node(node);
  return maker;
}

TEST(GltfLights, PointLightHasDefaultsAndALocalPosition) {
  const Scene scene = withLight({{"type", "point"}}, {{"translation", {0.5, 0.5, 3}}, {"name", "bulb"}}).read();
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::point);
  EXPECT_EQ(scene.lights[0].intensity, Rgb{1.f});
  EXPECT_EQ(scene.lights[0].position, (Vec3d{0, 0, 3}));
  EXPECT_EQ(scene.lights[0].name, "bulb");
}

TEST(GltfLights, SpotLooksAlongMinusZOfItsNodeWithDefaultCone) {
  const double h = std::sqrt(0.5);
  const Scene scene = withLight({{"type", "spot"}, {"intensity", 5}, {"color", {1, 0.5, 0}}},
                                {{"rotation", {-h, 0, 0, h}}, {"scale", {3, 1e-30, 1e30}}})
                          .read();
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.intensity, (Rgb{5, 2.5f, 0}));
  EXPECT_NEAR(light.direction.y, -1, 1e-12);
  EXPECT_EQ(light.cosInner, 1);
  EXPECT_NEAR(light.cosOuter, std::sqrt(0.5), 1e-15);
}

TEST(GltfLights, ConesOutsideTheirRangeAreBroughtIntoIt) {
  const Scene scene =
      withLight({{"type", "spot"}, {"spot", {{"innerConeAngle", 9}, {"outerConeAngle", 9}}}}, Json::object()).read();
  EXPECT_NEAR(scene.lights[0].cosOuter, 0, 1e-15);
  EXPECT_GE(scene.lights[0].cosInner, scene.lights[0].cosOuter);
}

TEST(GltfLights, ZeroScaleKeepsTheDirection) {
  const double h = std::sqrt(0.5);
  GltfMaker maker =
      withLight({{"type", "directional"}, {"intensity", 1000}}, {{"rotation", {-h, 0, 0, h}}, {"scale", {0, 0, 0}}});
  EXPECT_NEAR(maker.read().lights[0].direction.y, -1, 1e-12);
  maker.json["nodes"][1].erase("rotation");
  maker.json["nodes"][1].erase("scale");
  maker.json["nodes"][1]["matrix"] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 1};
  EXPECT_EQ(maker.read().lights[0].direction, (Vec3d{0, 0, -1}));
}

TEST(GltfLights, LightThatCannotBeIsRefused) {
  EXPECT_THAT(test::complaint(withLight({{"type", "point"}, {"intensity", -1}}, Json::object())),
              HasSubstr("negative"));
  EXPECT_THAT(test::complaint(withLight({{"type", "point"}, {"intensity", 1e300}}, Json::object())),
              HasSubstr("too large"));
  EXPECT_THAT(test::complaint(withLight({{"type", "lamp"}}, Json::object())),
              HasSubstr("none of point, spot and directional"));
}

TEST(GltfLights, LightsOutsideOfTheSceneDoNotShine) {
  GltfMaker maker = withLight({{"type", "point"}}, Json::object());
  maker.json["scenes"][0]["nodes"] = {0};
  EXPECT_TRUE(maker.read().lights.empty());
}

TEST(GltfCameras, PerspectiveCameraHasUnitAxesAndOrthographicIsListed) {
  GltfMaker maker = squareMaker();
  maker.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}};
  const double h = std::sqrt(0.5);
  maker.node({{"camera", 0},
              {"name", "view"},
              {"rotation", {0, h, 0, h}},
              {"scale", {5, 5, 5}},
              {"translation", {0.5, 0.5, 1}}});
  maker.node({{"camera", 1}});
  const Scene scene = maker.read();
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "view");
  EXPECT_EQ(camera.yfov, 0.7);
  EXPECT_NEAR(camera.back.x, 1, 1e-12);
  EXPECT_NEAR(camera.right.z, -1, 1e-12);
  EXPECT_NEAR(camera.up.y, 1, 1e-12);
  EXPECT_NEAR(camera.position.z, 1, 1e-12);
  EXPECT_THAT(scene.leftOut, Contains("orthographic cameras: left out"));
}

}  // namespace
}  // namespace lucarne::gltf_lights_test
