#include "player/camera_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/support/scene_builder.h"

namespace lucarne::camera_choice_test {
namespace {

Scene sceneWithCameras() {
  test::SceneBuilder b;
  b.addBox({-1, 0, -1}, {1, 2, 1});
  b.addCamera({5, 1, 0}, {0, 1, 0});
  b.addCamera({0, 1, 5}, {0, 1, 0});
  Scene scene = b.build();
  scene.cameras[0].name = "east";
  scene.cameras[1].name = "south";
  return scene;
}

TEST(CameraChoice, ByNameThenByNumberThenTheFirst) {
  const Scene scene = sceneWithCameras();
  EXPECT_EQ(chooseCamera(scene, "south").position, scene.cameras[1].position);
  EXPECT_EQ(chooseCamera(scene, "1").position, scene.cameras[1].position);
  EXPECT_EQ(chooseCamera(scene, "").position, scene.cameras[0].position);
}

TEST(CameraChoice, AnUnknownOneListsWhatThereIs) {
  for (const std::string wanted : {"west", "2", "-1", "99999999999999999999"}) {
    try {
      chooseCamera(sceneWithCameras(), wanted);
      FAIL() << wanted;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("east"), ::testing::HasSubstr("1 \"south\"")));
    }
  }
}

void expectUpright(const Camera& c) {
  EXPECT_NEAR(length(c.back), 1, 1e-12);
  EXPECT_NEAR(length(cross(c.right, c.up) - c.back), 0, 1e-12);
  EXPECT_NEAR(c.right.y, 0, 1e-12);
  EXPECT_GE(c.up.y, 0);
}

bool inside(const Vec3d& p, const Vec3d& lo, const Vec3d& hi) {
  return p.x > lo.x && p.y > lo.y && p.z > lo.z && p.x < hi.x && p.y < hi.y && p.z < hi.z;
}

TEST(CameraChoice, ARoomIsSeenFromInsideAlongItsLength) {
  for (const double scale : {1e-3, 1., 1e3}) {
    test::SceneBuilder b;
    b.addBox(Vec3d{-4, 0, -1.5} * scale, Vec3d{4, 2.8, 1.5} * scale, 0, true);
    b.addBox(Vec3d{-1, 0, -0.5} * scale, Vec3d{0, 0.8, 0.5} * scale);
    const Scene scene = b.build();
    const Camera camera = automaticCamera(scene);
    expectUpright(camera);
    const Vec3d eye = scene.frame.toWorld(camera.position) * (1 / scale);
    EXPECT_TRUE(inside(eye, {-4, 0, -1.5}, {4, 2.8, 1.5})) << eye.x << " " << eye.y << " " << eye.z;
    EXPECT_FALSE(inside(eye, {-1, 0, -0.5}, {0, 0.8, 0.5}));
    EXPECT_GT(std::abs(camera.back.x), 0.7);
  }
}

TEST(CameraChoice, ALoneObjectIsSeenFromOutsideAndWhole) {
  test::SceneBuilder b;
  b.addBox({-1, 0, -1}, {1, 2, 1});
  const Scene scene = b.build();
  const Camera camera = automaticCamera(scene);
  expectUpright(camera);
  for (int i = 0; i < 8; ++i) {
    const Vec3d corner = scene.frame.toLocal({i & 1 ? 1. : -1., i & 2 ? 2. : 0., i & 4 ? 1. : -1.}) - camera.position;
    const double depth = -dot(corner, camera.back);
    ASSERT_GT(depth, 0);
    EXPECT_LT(std::abs(dot(corner, camera.up)) / depth, std::tan(camera.yfov / 2));
  }
}

TEST(CameraChoice, ALampWithABaseAndAShadeIsSeenFromOutside) {
  test::SceneBuilder b;
  b.addBox({-0.3, 0, -0.3}, {0.3, 0.1, 0.3}, b.addDiffuse({0.2f, 0.2f, 0.2f}));
  b.addBox({-0.02, 0.1, -0.02}, {0.02, 1, 0.02}, b.addDiffuse({0.5f, 0.4f, 0.2f}));
  b.addBox({-0.4, 1, -0.4}, {0.4, 1.5, 0.4}, b.addDiffuse({0.9f, 0.9f, 0.8f}, Rgb(100.f)));
  const Scene scene = b.build();
  const Vec3d eye = scene.frame.toWorld(automaticCamera(scene).position);
  EXPECT_FALSE(inside(eye, {-0.4, 0, -0.4}, {0.4, 1.5, 0.4}));
  EXPECT_GT(length(eye - Vec3d{0, 0.75, 0}), 1.5);
}

TEST(CameraChoice, ACourtyardWithoutRoofIsSeenFromInside) {
  test::SceneBuilder b;
  b.addBox({-10, 0, -6}, {10, 5, 6}, 0, true);
  Scene scene = b.build();
  scene.triangles.erase(scene.triangles.begin() + 6, scene.triangles.begin() + 8);  // +y
  const Vec3d eye = scene.frame.toWorld(automaticCamera(scene).position);
  EXPECT_TRUE(inside(eye, {-10, 0, -6}, {10, 5, 6}));
}

TEST(CameraChoice, AOneSidedPlateIsSeenFromItsFront) {
  test::SceneBuilder b;
  b.addQuad({-1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {1, 0, 1});  // the front looks down
  const Scene scene = b.build();
  const Vec3d front = scene.scaledNormal(0);
  EXPECT_GT(dot(automaticCamera(scene).position, front), 0);
}

TEST(CameraChoice, NothingToSeeIsNoFailure) { expectUpright(automaticCamera(Scene{})); }

}  // namespace
}  // namespace lucarne::camera_choice_test
