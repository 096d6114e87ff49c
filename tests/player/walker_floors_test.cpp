// Stairs, slopes, ceilings, edges.
#include <gtest/gtest.h>

#include "tests/player/walk_fixture.h"

namespace lucarne::walker_floors_test {
namespace {

using test::ahead;
using test::yawTo;

/// Ground of 20 m by 6 m, and steps along +x from x = 4 on up to a landing.
test::SceneBuilder stairs(double rise, double tread, int count) {
  test::SceneBuilder b;
  b.addQuad({0, 0, 6}, {20, 0, 6}, {20, 0, 0}, {0, 0, 0});
  for (int i = 0; i < count; ++i) b.addBox({4 + tread * i, 0, 2}, {4 + tread * count + 3, rise * (i + 1), 4});
  return b;
}

TEST(WalkerFloors, StairsAreWalkedUpAndDown) {
  struct Kind {
    double rise, tread;
  };
  for (const Kind k : {Kind{0.17, 0.29}, Kind{0.20, 0.25}, Kind{0.34, 0.40}, Kind{0.02, 0.3}}) {
    for (const bool run : {false, true}) {
      test::Walk w(stairs(k.rise, k.tread, 8));
      w.standAt({2, 0, 3}, yawTo(1, 0));
      while (w.feet().x < 4 + 8 * k.tread + 1) {
        const double before = w.feet().x;
        w.hold(ahead(run), 0.2);
        ASSERT_GT(w.feet().x, before + 0.05) << k.rise << ": stuck at " << w.feet().x;
      }
      EXPECT_NEAR(w.feet().y, 8 * k.rise, 0.01) << k.rise;
      w.standAt(w.feet(), yawTo(-1, 0));
      while (w.feet().x > 3) {
        const double before = w.feet().x;
        w.hold(ahead(run), 0.2);
        ASSERT_LT(w.feet().x, before - 0.05) << k.rise;
      }
      w.hold({}, 1);
      EXPECT_NEAR(w.feet().y, 0, 0.01);
    }
  }
}

TEST(WalkerFloors, AStepTooHighIsAWall) {
  test::Walk w(stairs(0.45, 0.4, 3));
  w.standAt({2, 0, 3}, yawTo(1, 0));
  w.hold(ahead(true), 3);
  EXPECT_NEAR(w.feet().y, 0, 1e-6);
  EXPECT_LT(w.feet().x, 4);
}

TEST(WalkerFloors, TheEyeGlidesOverSteps) {
  test::Walk w(stairs(0.17, 0.29, 8));
  w.standAt({2, 0, 3}, yawTo(1, 0));
  double before = w.walker.state().eye().y;
  for (int i = 0; i < 4 * kWalkTicks; ++i) {
    w.hold(ahead(), 1.0 / kWalkTicks);
    EXPECT_LT(std::abs(w.walker.state().eye().y - before), 0.03);
    before = w.walker.state().eye().y;
  }
}

/// A ramp along +x, infinite for the walker.
double climbed(double degrees) {
  test::SceneBuilder b;
  const double rise = 20 * std::tan(degrees * 3.14159265358979 / 180);
  b.addQuad({-10, 0, 6}, {4, 0, 6}, {4, 0, 0}, {-10, 0, 0});
  b.addQuad({4, 0, 6}, {24, rise, 6}, {24, rise, 0}, {4, 0, 0});
  test::Walk w(b);
  w.standAt({2, 0, 3}, yawTo(1, 0.2));
  w.hold(ahead(), 3);
  return w.feet().y;
}

TEST(WalkerFloors, SlopesUpTo45DegreesAreFloor) {
  EXPECT_GT(climbed(10), 0.3);
  EXPECT_GT(climbed(30), 1);
  EXPECT_GT(climbed(44), 1.5);
  EXPECT_LT(climbed(48), 0.4);
  EXPECT_LT(climbed(60), 0.4);
  EXPECT_LT(climbed(80), 0.4);
}

TEST(WalkerFloors, OnASlopeTooSteepOneSkidsDown) {
  test::SceneBuilder b;
  b.addQuad({-10, 0, 6}, {4, 0, 6}, {4, 0, 0}, {-10, 0, 0});
  b.addQuad({4, 0, 6}, {8, 8, 6}, {8, 8, 0}, {4, 0, 0});  // 63°
  test::Walk w(b);
  w.standAt({6, 4.6, 3});
  w.hold({}, 6);
  EXPECT_NEAR(w.feet().y, 0, 0.4);
  EXPECT_LT(w.feet().x, 4.3);
  EXPECT_NEAR(w.feet().z, 3, 0.01);
  const Vec3d rest = w.feet();
  w.hold({}, 1);
  EXPECT_LT(length(w.feet() - rest), 0.01);
}

TEST(WalkerFloors, CablesAndRoundThingsAreSteppedOver) {
  test::SceneBuilder b;
  b.addQuad({0, 0, 6}, {20, 0, 6}, {20, 0, 0}, {0, 0, 0});
  constexpr int n = 16;
  for (int i = 0; i < n; ++i) {  // a pipe of 12 cm along z
    const double a = 6.283185307179586 * i / n, c = 6.283185307179586 * (i + 1) / n;
    const auto at = [](double angle, double z) {
      return Vec3d{4 + 0.06 * std::cos(angle), 0.06 + 0.06 * std::sin(angle), z};
    };
    b.addQuad(at(a, 0), at(a, 6), at(c, 6), at(c, 0));
  }
  for (const bool run : {false, true}) {
    test::Walk w(b);
    w.standAt({3, 0, 3}, yawTo(1, 0));
    w.hold(ahead(run), 2);
    EXPECT_GT(w.feet().x, 5.5);
    EXPECT_NEAR(w.feet().y, 0, 0.01);
  }
}

TEST(WalkerFloors, ALowCeilingKeepsOneCrouched) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 4}, 0, true);
  b.addBox({0, 1.3, 0}, {4, 1.5, 2});
  test::Walk w(b);
  w.standAt({2, 0, 3.4}, yawTo(0, -1));
  w.hold(ahead(), 1);
  EXPECT_GT(w.feet().z, 2.0) << "does not fit upright";
  WalkInput crouched = ahead();
  crouched.crouch = true;
  w.hold(crouched, 3);
  EXPECT_LT(w.feet().z, 1);
  EXPECT_NEAR(w.walker.state().eye().y, w.walker.state().feet.y + 1.0, 1e-9);
  w.hold({}, 1);
  EXPECT_LT(w.walker.state().height, 1.31);
  WalkInput back;
  back.forward = -1;
  w.hold(back, 3);
  EXPECT_GT(w.feet().z, 2.2);
  EXPECT_NEAR(w.walker.state().height, walk_body::kStanding, 1e-9);
  EXPECT_NEAR(w.walker.state().eye().y, w.walker.state().feet.y + 1.65, 1e-9);
}

TEST(WalkerFloors, OverAnEdgeOneFallsAsStonesDo) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {3, 3, 3});
  b.addQuad({-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20});
  test::Walk w(b);
  w.standAt({2.5, 3, 1.5}, yawTo(1, 0));
  while (w.walker.state().grounded) w.hold(ahead(), 1.0 / kWalkTicks);
  const double edge = w.feet().y;
  w.hold({}, 0.5);
  EXPECT_NEAR(edge - w.feet().y, 0.5 * 9.81 * 0.25, 0.1);
  w.hold({}, 1);
  EXPECT_NEAR(w.feet().y, 0, 1e-6);
  EXPECT_TRUE(w.walker.state().grounded);
}

TEST(WalkerFloors, OutOfTheWorldPutsOneBack) {
  test::SceneBuilder b;
  b.addQuad({0, 0, 6}, {6, 0, 6}, {6, 0, 0}, {0, 0, 0});
  test::Walk w(b);
  w.standAt({3, 0, 3}, yawTo(1, 0));
  w.hold(ahead(), 5);  // walks off, falls, comes back, walks off, …
  w.hold({}, 3);
  EXPECT_NEAR(w.feet().y, 0, 0.01);
  EXPECT_TRUE(w.feet().x > 3 && w.feet().x < 6.2) << w.feet().x;
}

TEST(WalkerFloors, AJumpComesDownAgain) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 2.2, 4}, 0, true);
  test::Walk w(b);
  w.standAt({2, 0, 2});
  WalkInput jump;
  jump.upward = 1;
  double highest = 0;
  for (int i = 0; i < 60; ++i) {
    w.hold(jump, 1.0 / kWalkTicks);
    highest = std::max(highest, w.feet().y);
  }
  EXPECT_NEAR(highest, 9.0 / (2 * 9.81), 0.03);
  w.hold({}, 1);
  EXPECT_NEAR(w.feet().y, 0, 1e-6);
}

TEST(WalkerFloors, FlyingGoesWhereOneLooksAndThroughWalls) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 4}, 0, true);
  test::Walk w(b);
  WalkerState s;
  s.flying = true;
  s.pitch = 0.5;
  w.walker.set(s);
  w.hold(ahead(true), 2);
  const Vec3d moved = w.walker.state().feet;
  EXPECT_NEAR(length(moved), 2 * 3 * w.pace.fly, 1e-6);
  EXPECT_NEAR(moved.y / length(moved), std::sin(0.5), 1e-9);
}

}  // namespace
}  // namespace lucarne::walker_floors_test
