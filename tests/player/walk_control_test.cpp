// Who leads the camera.
#include "player/walk_control.h"

#include <gtest/gtest.h>

#include "player/camera_choice.h"
#include "tests/player/walk_fixture.h"

namespace lucarne::walk_control_test {
namespace {

/// A hall with two cameras at eye height, `shift` metres along x of where it usually is.
std::shared_ptr<const WalkScene> hall(double shift = 0) {
  test::SceneBuilder b;
  b.addBox({shift, 0, 0}, {shift + 12, 3, 8}, 0, true);
  b.addCamera({shift + 2, 1.65, 4}, {shift + 5, 1.65, 4});
  b.addCamera({shift + 10, 1.65, 4}, {shift + 5, 1.65, 4});
  const Scene scene = b.build();
  return std::make_shared<const WalkScene>(scene, scene.cameras.front());
}

Vec3d eyeOf(const WalkControl& control, const WalkScene& scene) {
  return scene.world.frame().toWorld(control.camera().position);
}

void expectAt(const WalkControl& control, const WalkScene& scene, Vec3d eye) {
  const Vec3d is = eyeOf(control, scene);
  EXPECT_LT(length(is - eye), 0.02) << is.x << " " << is.y << " " << is.z;
}

TEST(WalkControl, KeysGoThroughTheCamerasAndBack) {
  const auto scene = hall();
  WalkControl control(scene, false);
  EXPECT_FALSE(control.flying());
  EXPECT_EQ(control.startNote(), "");
  expectAt(control, *scene, {2, 1.65, 4});
  control.press(WalkKey::nextCamera);
  expectAt(control, *scene, {2, 1.65, 4});
  control.press(WalkKey::nextCamera);
  expectAt(control, *scene, {10, 1.65, 4});
  control.advance(0.4, test::ahead());
  control.press(WalkKey::startAgain);
  expectAt(control, *scene, {10, 1.65, 4});
  control.press(WalkKey::nextCamera);
  expectAt(control, *scene, {2, 1.65, 4});
  control.press(WalkKey::previousCamera);
  expectAt(control, *scene, {10, 1.65, 4});
}

TEST(WalkControl, FlyingUpAndWalkingAgainComesDown) {
  const auto scene = hall();
  WalkControl control(scene, false);
  control.press(WalkKey::fly);
  WalkInput up;
  up.upward = 1;
  for (int i = 0; i < 3; ++i) control.advance(0.2, up);
  EXPECT_GT(eyeOf(control, *scene).y, 2.2);
  control.press(WalkKey::fly);
  EXPECT_FALSE(control.flying());
  control.advance(0.5, {});
  expectAt(control, *scene, {2, 1.65, 4});
}

TEST(WalkControl, APathLeadsUntilOneMoves) {
  const auto scene = hall();
  WalkControl control(scene, false);
  control.replay({1, 40, {{{3, 1.65, 4}, -90, 0}, {{7, 1.65, 4}, -90, 0}}});
  control.advance(0.25, {});
  expectAt(control, *scene, {4, 1.65, 4});
  EXPECT_NEAR(control.camera().yfov, 40 * 3.14159265358979 / 180, 1e-9);
  WalkInput left;
  left.sideways = -1;
  control.advance(0.25, left);
  EXPECT_FALSE(control.replaying());
  EXPECT_NEAR(eyeOf(control, *scene).x, 5, 0.02) << "from where the path was";
  EXPECT_LT(eyeOf(control, *scene).z, 3.8);
  control.replay({1, 40, {{{3, 1.65, 4}, 0, 0}, {{7, 2.8, 4}, 0, 0}}});
  for (int i = 0; i < 5; ++i) control.advance(0.3, {});
  EXPECT_FALSE(control.replaying());
  expectAt(control, *scene, {7, 2.8, 4});
  EXPECT_TRUE(control.flying()) << "the path ended in the air";
}

TEST(WalkControl, MapsLoadedAgainLeaveOneWhereOneStands) {
  const auto scene = hall(), other = hall(3);
  WalkControl control(scene, false);
  control.record();
  control.advance(0.4, test::ahead());
  const Vec3d eye = eyeOf(control, *scene);
  EXPECT_NEAR(eye.x, 2.6, 0.02);
  control.moveTo(hall());
  expectAt(control, *scene, eye);
  control.press(WalkKey::nextCamera);
  control.press(WalkKey::nextCamera);
  control.moveTo(other);  // another origin: the same place in metres
  expectAt(control, *other, {10, 1.65, 4});
  control.advance(0.4, {});
  const WalkPath path = control.takeRecording();
  EXPECT_EQ(path.poses.size(), 97u);
  EXPECT_LT(length(path.poses.back().eye - Vec3d{10, 1.65, 4}), 0.02);
  control.press(WalkKey::fly);
  control.moveTo(scene);
  EXPECT_TRUE(control.flying());
}

TEST(WalkControl, MapsOfAnotherPlaceTakeOneToTheirFloor) {
  WalkControl control(hall(), false);
  const auto far = hall(100);
  control.moveTo(far);
  control.advance(0.4, {});
  EXPECT_FALSE(control.flying());
  EXPECT_GT(eyeOf(control, *far).x, 100.2);
  EXPECT_NEAR(eyeOf(control, *far).y, 1.65, 0.02);
}

}  // namespace
}  // namespace lucarne::walk_control_test
