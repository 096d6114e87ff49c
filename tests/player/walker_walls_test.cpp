// Walls hold, whatever the walker does.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/player/walk_fixture.h"

namespace lucarne::walker_walls_test {
namespace {

using test::ahead;
using test::yawTo;

constexpr double kRadius = walk_body::kRadius;

test::SceneBuilder roomOf(Vec3d size) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, size, 0, true);
  return b;
}

/// A table of 1.6 m by 0.8 m with four legs.
void addTable(test::SceneBuilder& b, Vec3d at) {
  b.addBox(at + Vec3d{0, 0.70, 0}, at + Vec3d{1.6, 0.74, 0.8});
  for (const double x : {0.0, 1.55}) {
    for (const double z : {0.0, 0.75}) b.addBox(at + Vec3d{x, 0, z}, at + Vec3d{x + 0.05, 0.70, z + 0.05});
  }
}

TEST(WalkerWalls, OneWalksAtItsPaceAndStopsAtTheWall) {
  test::Walk w(roomOf({6, 3, 6}));
  w.standAt({3, 0, 5}, yawTo(0, -1));
  w.hold(ahead(), 1);
  EXPECT_NEAR(w.feet().z, 3.5, 1e-6);
  w.hold(ahead(true), 5);
  EXPECT_NEAR(w.feet().z, kRadius, 0.002);
  EXPECT_NEAR(w.feet().x, 3, 1e-6);
  EXPECT_NEAR(w.feet().y, 0, 1e-6);
}

TEST(WalkerWalls, SlidesAlongThemIntoTheCorner) {
  test::Walk w(roomOf({6, 3, 6}));
  w.standAt({3, 0, 1}, yawTo(1, -1));
  w.hold(ahead(), 1.5);
  EXPECT_NEAR(w.feet().z, kRadius, 0.002);
  EXPECT_GT(w.feet().x, 4.4);  // 1.5 s · 1.5 m/s · cos 45°
  w.hold(ahead(), 5);
  EXPECT_NEAR(w.feet().x, 6 - kRadius, 0.002);
  EXPECT_NEAR(w.feet().z, kRadius, 0.002);
}

TEST(WalkerWalls, HoldAtAnySpeed) {
  for (const double pace : {5., 50., 5e3, 1e9}) {
    test::Walk w(roomOf({6, 3, 6}));
    w.pace.walk = pace;
    for (const double yaw : {0., 0.3, 0.8, 2.5}) {
      w.standAt({3, 0, 3}, yaw);
      w.hold(ahead(true), 0.5);
      EXPECT_GE(std::min({w.feet().x, w.feet().z, 6 - w.feet().x, 6 - w.feet().z}), kRadius - 0.002) << pace;
    }
  }
}

TEST(WalkerWalls, ThinWallsSeenFromBehindHold) {
  test::SceneBuilder b = roomOf({6, 3, 6});
  b.addQuad({0, 0, 3}, {6, 0, 3}, {6, 3, 3}, {0, 3, 3});  // one side, without thickness
  for (const double side : {-1., 1.}) {
    test::Walk w(b);
    w.standAt({3, 0, 3 + side * 2}, yawTo(0.2, -side));
    w.hold(ahead(true), 3);
    EXPECT_GE(side * (w.feet().z - 3), kRadius - 0.002);
  }
}

TEST(WalkerWalls, ADoorOf70CentimetresLetsOneThrough) {
  test::SceneBuilder b = roomOf({6, 3, 6});
  b.addBox({0, 0, 2.9}, {2.65, 3, 3.0});
  b.addBox({3.35, 0, 2.9}, {6, 3, 3.0});
  b.addBox({2.65, 2.0, 2.9}, {3.35, 3, 3.0});   // lintel
  b.addBox({2.65, 0, 2.9}, {3.35, 0.03, 3.0});  // sill
  for (const double aside : {-0.2, 0., 0.09}) {
    test::Walk w(b);
    w.standAt({3 + aside, 0, 5}, yawTo(0, -1));
    w.hold(ahead(), 3);
    EXPECT_LT(w.feet().z, 2) << aside;
    w.standAt({3 + aside, 0, 5}, yawTo(0, -1));
    w.hold(ahead(true), 1.5);
    EXPECT_LT(w.feet().z, 2) << aside;
  }
}

TEST(WalkerWalls, ASlitNarrowerThanTheBodyHolds) {
  test::SceneBuilder b = roomOf({6, 3, 6});
  b.addBox({0, 0, 2.9}, {2.8, 3, 3.0});
  b.addBox({3.2, 0, 2.9}, {6, 3, 3.0});
  test::Walk w(b);
  w.standAt({3, 0, 5}, yawTo(0, -1));
  w.hold(ahead(true), 3);
  EXPECT_GT(w.feet().z, 3);
}

/// From all around a table straight at it: one comes to a stop or past it, and always away again.
TEST(WalkerWalls, TableLegsDoNotTrap) {
  test::SceneBuilder b = roomOf({8, 3, 8});
  addTable(b, {3.2, 0, 3.6});
  test::Walk w(b);
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    const Vec3d out{std::cos(angle), 0, std::sin(angle)};
    w.standAt(Vec3d{4, 0, 4} + out * 2.5, yawTo(-out.x, -out.z));
    w.hold(ahead(true), 0.8);
    const Vec3d met = w.feet();
    EXPECT_FALSE(met.x > 3.2 && met.x < 4.8 && met.z > 3.6 && met.z < 4.4) << "stands in the table";
    double farthest = 0;
    for (int k = 0; k < 8; ++k) {
      w.standAt(met, k * std::numbers::pi / 4);
      w.hold(ahead(), 0.5);
      farthest = std::max(farthest, length(w.feet() - met));
    }
    EXPECT_NEAR(farthest, 0.75, 0.01) << i;
  }
}

TEST(WalkerWalls, NobodyEverLeavesAClosedRoom) {
  test::SceneBuilder b = roomOf({5, 2.6, 4});
  addTable(b, {1, 0, 1.5});
  b.addBox({3.4, 0, 0.3}, {3.9, 0.3, 0.9});                           // a stool
  b.addQuad({3.5, 0, 4}, {5, 0, 2.5}, {5, 2.6, 2.5}, {3.5, 2.6, 4});  // a slanting wall
  b.addQuad({0, 0, 0}, {1.2, 1.6, 0}, {1.2, 1.6, 1.2}, {0, 0, 1.2});  // a steep slope
  test::Walk w(b);
  w.standAt({2.5, 0, 3});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  WalkInput in;
  for (int i = 0; i < 100'000; ++i) {
    if (i % 20 == 0)
      in = {std::round(1.4 * u(random)), std::round(1.4 * u(random)), u(random), u(random) > 0, u(random) > 0};
    in.turnX = 0.05 * u(random);
    w.pace.walk = i % 3000 < 1000 ? 12 : 1.5;
    w.walker.tick(in, w.pace);
    const Vec3d p = w.feet();
    ASSERT_TRUE(p.x > kRadius - 0.01 && p.x < 5 - kRadius + 0.01 && p.z > kRadius - 0.01 && p.z < 4 - kRadius + 0.01)
        << i << ": " << p.x << " " << p.y << " " << p.z;
    ASSERT_TRUE(p.y > -0.36 && p.y + w.walker.state().height < 2.6 + 0.001) << i << ": " << p.y;
    ASSERT_FALSE(w.walker.state().flying);
  }
}

}  // namespace
}  // namespace lucarne::walker_walls_test
