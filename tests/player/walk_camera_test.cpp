#include "player/walk_camera.h"

#include <gtest/gtest.h>

#include "player/camera_choice.h"
#include "player/render_scale.h"
#include "tests/support/scene_builder.h"

namespace lucarne {
namespace {

void expectNear(Vec3d a, Vec3d b) { EXPECT_LT(length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z; }

TEST(WalkCamera, StartsWhereTheCameraLooks) {
  for (const Vec3d target : {Vec3d{0, 0, -1}, Vec3d{1, 0.5, 0.2}, Vec3d{-1, -3, 2}}) {
    const Camera start = lookAt({0.3, 0.2, 0.1}, Vec3d{0.3, 0.2, 0.1} + target, 0.7);
    const Camera camera = WalkCamera(start, 1).camera();
    expectNear(camera.position, start.position);
    expectNear(camera.back, start.back);
    expectNear(camera.right, start.right);
    expectNear(camera.up, start.up);
    EXPECT_EQ(camera.yfov, 0.7);
  }
}

TEST(WalkCamera, WalksAlongTheFloorAtItsSpeed) {
  WalkCamera walker(lookAt({0, 1, 0}, {0, 0, -1}, 1), 2);  // looking down
  WalkInput forward;
  forward.forward = 1;
  walker.move(forward, 0.5);
  expectNear(walker.camera().position, {0, 1, -1});
  WalkInput slanting{1, 1, 0, true};
  walker.move(slanting, 0.5);
  EXPECT_NEAR(length(walker.camera().position - Vec3d{0, 1, -1}), 3, 1e-9);  // three times as fast, in all
}

TEST(WalkCamera, TurningRightLooksRightAndDownIsBounded) {
  WalkCamera walker(lookAt({0, 0, 0}, {0, 0, -1}, 1), 1);
  WalkInput turn;
  turn.turnX = 0.1;
  walker.move(turn, 1);
  EXPECT_LT(walker.camera().back.x, 0);  // looks toward +x
  turn = {};
  turn.turnY = 10;
  walker.move(turn, 1);
  EXPECT_GT(walker.camera().back.y, 0.99);
  EXPECT_GT(walker.camera().up.y, 0);
}

TEST(WalkCamera, SpeedFitsTheScene) {
  for (const double metres : {1e-3, 5., 1e4}) {
    test::SceneBuilder b;
    b.addBox({0, 0, 0}, Vec3d{1, 1, 1} * metres);
    const Scene scene = b.build();
    const double seconds = metres / scene.frame.scale / walkSpeed(scene);
    EXPECT_GT(seconds, 0.5) << metres;
    EXPECT_LT(seconds, 30) << metres;
  }
}

TEST(RenderScale, SlowMotionIsDrawnCoarserAndRestInFull) {
  RenderScale scale(0.8);
  for (int i = 0; i < 20; ++i) scale.update(0.1, true);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.4);
  scale.update(0.1, false);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.4);
  for (int i = 0; i < 5; ++i) scale.update(0.1, false);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.8);
  for (int i = 0; i < 20; ++i) scale.update(0.001, true);
  EXPECT_DOUBLE_EQ(scale.scale(), 0.8);
}

}  // namespace
}  // namespace lucarne
