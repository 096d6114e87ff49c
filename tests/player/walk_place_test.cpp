// Where a walk begins.
#include "player/walk_place.h"

#include <gtest/gtest.h>

#include "player/camera_choice.h"
#include "tests/player/walk_fixture.h"

namespace lucarne::walk_place_test {
namespace {

/// startAt() a camera of the scene's metres; feet in metres.
struct Start {
  Start(const test::SceneBuilder& builder, Vec3d eye, Vec3d target = {}, bool flying = false)
      : world(builder.build()), camera(lookAt(world.frame().toLocal(eye), world.frame().toLocal(target), 0.8)) {
    state = startAt(world, camera, flying);
    feet = state.feet + world.frame().origin;
  }
  WalkWorld world;
  Camera camera;
  WalkerState state;
  Vec3d feet;
};

test::SceneBuilder room(double scale = 1) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, Vec3d{6, 3, 6} * scale, 0, true);
  return b;
}

TEST(WalkPlace, ACameraOverFloorKeepsItsEye) {
  const Start s(room(), {3, 1.5, 4}, {1, 1.2, 1});
  EXPECT_FALSE(s.state.flying);
  EXPECT_LT(length(s.state.eye() + s.world.frame().origin - Vec3d{3, 1.5, 4}), 0.01);
  const Camera camera = cameraOf(s.world, s.state, s.state, 1, 0.8);
  EXPECT_LT(length(camera.back - s.camera.back), 1e-9);
  EXPECT_LT(length(camera.up - s.camera.up), 1e-9);
}

TEST(WalkPlace, ACameraInTheAirComesDown) {
  const Start s(room(), {3, 2.8, 4}, {1, 0, 1});
  EXPECT_FALSE(s.state.flying);
  EXPECT_NEAR(s.feet.y, 0, 0.01);
  EXPECT_LT(std::hypot(s.feet.x - 3, s.feet.z - 4), 0.3);
}

TEST(WalkPlace, ACameraInAWallOrOutsideGoesToTheNearestFloor) {
  for (const Vec3d eye : {Vec3d{3, 1.5, 6.0}, Vec3d{3, 1.5, 5.9}, Vec3d{3, 1.5, 14}, Vec3d{-4, 1.5, 3}}) {
    const Start s(room(), eye, {3, 1, 3});
    EXPECT_FALSE(s.state.flying);
    EXPECT_TRUE(s.feet.x > 0.2 && s.feet.x < 5.8 && s.feet.z > 0.2 && s.feet.z < 5.8) << s.feet.x << " " << s.feet.z;
    EXPECT_NEAR(s.feet.y, 0, 0.01);
  }
}

TEST(WalkPlace, UnderALowCeilingItStartsCrouched) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {6, 1.3, 6}, 0, true);
  const Start s(b, {3, 0.9, 3});
  EXPECT_FALSE(s.state.flying);
  EXPECT_NEAR(s.state.height, walk_body::kCrouching, 1e-9);
}

TEST(WalkPlace, ScenesOfAnyScaleAreWalkedOrFlown) {
  for (const double scale : {1e-4, 0.008, 0.1, 1., 30., 800., 1e5}) {
    const Start s(room(scale), Vec3d{3, 1.5, 4} * scale, Vec3d{1, 1, 1} * scale);
    EXPECT_EQ(s.state.flying, scale < 0.9) << scale;
    test::SceneBuilder b = room(scale);
    test::Walk w(b);
    w.walker.set(s.state);
    w.pace = paceFor(w.world);
    w.hold(test::ahead(true), 2);
    const Vec3d p = (w.walker.state().eye() + w.world.frame().origin) / scale;
    EXPECT_TRUE(isFinite(p));
    EXPECT_GT(length(w.walker.state().feet - s.state.feet), scale < 0.9 ? 0.05 * 6 * scale : 1) << scale;
  }
}

TEST(WalkPlace, WithoutFloorOneFlies) {
  test::SceneBuilder walls;
  walls.addQuad({0, 0, 0}, {6, 0, 0}, {6, 3, 0}, {0, 3, 0});
  walls.addQuad({0, 0, 6}, {0, 0, 0}, {0, 3, 0}, {0, 3, 6});
  const Start s(walls, {3, 1.5, 4});
  EXPECT_TRUE(s.state.flying);
  EXPECT_LT(length(s.state.eye() + s.world.frame().origin - Vec3d{3, 1.5, 4}), 1e-6);
  const Start none(test::SceneBuilder(), {0, 0, 2});
  EXPECT_TRUE(none.state.flying);
}

TEST(WalkPlace, AskedToFlyItStaysWhereTheCameraIs) {
  const Start s(room(), {3, 2.8, 4}, {1, 0, 1}, true);
  EXPECT_TRUE(s.state.flying);
  EXPECT_LT(length(s.state.eye() + s.world.frame().origin - Vec3d{3, 2.8, 4}), 1e-6);
}

}  // namespace
}  // namespace lucarne::walk_place_test
