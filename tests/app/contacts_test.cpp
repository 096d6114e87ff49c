// Where geometry stands on a chart: no light comes through, and no rim is left.
#include <gtest/gtest.h>

#include <numbers>

#include "dlm/resolve.h"
#include "tests/app/bake_fixture.h"

namespace lucarne::contacts_test {
namespace {

using test::BakedScene;
using test::ProbedBake;
using test::SceneBuilder;

double readAt(const ProbedBake& bake, Vec3d position, Vec3d normal) {
  return static_cast<double>(luminance(Rgb(bake.at(position, normal).irradiance)));
}

/// A floor of 2 × 2 m with its middle at the origin, one chart, absorbing; a bulb two metres over it.
SceneBuilder floorUnderBulb(Vec3d bulb) {
  SceneBuilder s;
  s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, s.addDiffuse(Rgb(0.f)));
  Light light;
  light.kind = LightKind::point;
  light.intensity = Rgb(100.f);
  light.position = bulb;
  s.addLight(light);
  return s;
}

/// Of a bulb of 100 cd, over an absorbing floor.
double underBulb(Vec3d bulb, Vec3d p) {
  const Vec3d d = bulb - p;
  return 100 * d.y / (dot(d, d) * length(d));
}

/// A box without bottom, or with it.
void addLeg(SceneBuilder& s, Vec3d lo, Vec3d hi, std::uint32_t material, bool bottom) {
  const auto corner = [&](int i) { return Vec3d{i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}; };
  constexpr int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}};
  for (int f = 0; f < (bottom ? 6 : 5); ++f)
    s.addQuad(corner(faces[f][0]), corner(faces[f][1]), corner(faces[f][2]), corner(faces[f][3]), material);
}

struct Leg {
  const char* name;
  bool doubleSided, bottom;
  double foot;          // height of its lower end, m
  double half = 0.043;  // of its width, m
};

class LegOnAFloor : public testing::TestWithParam<Leg> {};

// The bulb is straight over the leg, so that its shadow is hardly wider than itself.
TEST_P(LegOnAFloor, LeavesNoRim) {
  const Vec3d bulb{0.031, 1.5, 0.017};
  SceneBuilder s = floorUnderBulb(bulb);
  Material m = test::diffuseMaterial(Rgb(0.f));
  m.doubleSided = GetParam().doubleSided;
  const double w = GetParam().half;
  addLeg(s, {0.031 - w, GetParam().foot, 0.017 - w}, {0.031 + w, 0.02, 0.017 + w}, s.addMaterial(m), GetParam().bottom);
  BakeOptions options = test::quickOptions(2'000'000, 16);
  const BakedScene b(s.build(), options);
  const ProbedBake bake(b, std::string("leg_") + GetParam().name);
  // The top, 1.48 m under the bulb, throws a shadow of 1.4 % of its half width around itself.
  const double shadow = w * 1.5 / 1.48, blur = (shadow - w) * 16;  // of a texel, which is as much darker
  for (const double away : {0.004, 0.02, 0.05, 0.1}) {
    for (int side = 0; side < 4; ++side) {
      for (const double along : {-0.03, 0.0, 0.02}) {
        const double r = shadow + away;
        const Vec3d p = Vec3d{0.031, 0, 0.017} +
                        (side < 2 ? Vec3d{side == 0 ? r : -r, 0, along} : Vec3d{along, 0, side == 2 ? r : -r});
        EXPECT_NEAR(readAt(bake, p, {0, 1, 0}) / underBulb(bulb, p), 1, 0.05 + blur)
            << away << " m from side " << side << " at " << along;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, LegOnAFloor,
                         testing::Values(Leg{"solid", false, true, 0}, Leg{"open_below", false, false, 0},
                                         Leg{"two_sided", true, false, 0}, Leg{"into_the_floor", false, true, -0.02},
                                         Leg{"two_sided_into_the_floor", true, true, -0.02},
                                         Leg{"a_hair_above", true, true, 0.0005},
                                         Leg{"two_sided_chest", true, true, 0, 0.21},
                                         Leg{"two_sided_chest_into_the_floor", true, true, -0.02, 0.21}),
                         [](const auto& leg) { return leg.param.name; });

// A rug 8 mm up throws a shadow 2 mm wide, which takes 3.5 % from a texel's light.
TEST(RugOnAFloor, LeavesNoRim) {
  for (const double height : {0.002, 0.008}) {
    const Vec3d bulb{0, 1.5, 0};
    SceneBuilder s = floorUnderBulb(bulb);
    s.addQuad({-0.33, height, 0.27}, {0.21, height, 0.27}, {0.21, height, -0.41}, {-0.33, height, -0.41},
              s.addDiffuse(Rgb(0.f)));
    const BakedScene b(s.build(), test::quickOptions(4'000'000, 16));
    const ProbedBake bake(b, "rug");
    for (const Vec3d p : {Vec3d{0.22, 0, 0.1}, Vec3d{0.24, 0, -0.2}, Vec3d{-0.34, 0, 0.05}, Vec3d{-0.37, 0, -0.1},
                          Vec3d{0.1, 0, 0.28}, Vec3d{-0.2, 0, 0.31}, Vec3d{0.0, 0, -0.42}, Vec3d{0.05, 0, -0.45}})
      EXPECT_NEAR(readAt(bake, p, {0, 1, 0}) / underBulb(bulb, p), 1, 0.06)
          << p.x << " " << p.z << " rug at " << height;
  }
}

/// A room cut in two by a wall across a floor that is one chart; a bulb in the right half.
struct TwoRooms {
  double left, right;  // faces of the wall
  Vec3d bulb{1, 1, 0};
  SceneBuilder scene;

  TwoRooms(double middle, double thickness) : left(middle - thickness / 2), right(middle + thickness / 2) {
    const auto grey = scene.addDiffuse(Rgb(0.f));
    scene.addBox({-2, 0, -1}, {2, 2, 1}, grey, true);
    scene.addQuad({left, 0, -1}, {left, 0, 1}, {left, 2, 1}, {left, 2, -1}, grey);      // faces −x
    scene.addQuad({right, 0, 1}, {right, 0, -1}, {right, 2, -1}, {right, 2, 1}, grey);  // faces +x
    Light light;
    light.kind = LightKind::point;
    light.intensity = Rgb(100.f);
    light.position = bulb;
    scene.addLight(light);
  }
};

class ThinWall : public testing::TestWithParam<double> {};

TEST_P(ThinWall, KeepsItsTwoSidesApart) {
  const TwoRooms rooms(GetParam(), 0.001);
  const BakedScene b(rooms.scene.build(), test::quickOptions(1'000'000, 16));
  const ProbedBake bake(b, "thin_wall");
  const double texel = 1.0 / 16;
  for (const double z : {-0.83, -0.4, 0.013, 0.33, 0.77}) {
    EXPECT_EQ(readAt(bake, {rooms.left, 0.7, z}, {-1, 0, 0}), 0) << "the dark side of the wall at " << z;
    EXPECT_GT(readAt(bake, {rooms.right, 0.7, z}, {1, 0, 0}), 5);
    // On the floor, which both rooms share, nothing but the texel that the wall stands in and bilinear lookup mix.
    EXPECT_EQ(readAt(bake, {rooms.left - 1.55 * texel, 0, z}, {0, 1, 0}), 0) << z;
    const Vec3d p{rooms.right + 1.55 * texel, 0, z};
    EXPECT_NEAR(readAt(bake, p, {0, 1, 0}) / underBulb(rooms.bulb, p), 1, 0.06) << z;
  }
}

INSTANTIATE_TEST_SUITE_P(At, ThinWall, testing::Values(0.0, 0.011, 0.03125, 0.05));

TEST(SealedBox, InABrightRoomReadsZero) {
  SceneBuilder s;
  s.addBox({-2, 0, -2}, {2, 2, 2}, s.addDiffuse(Rgb(0.5f)), true);
  s.addQuad({-1, 1.9, -1}, {1, 1.9, -1}, {1, 1.9, 1}, {-1, 1.9, 1}, s.addDiffuse(Rgb(0.5f), Rgb(500.f)));
  Material m = test::diffuseMaterial(Rgb(0.5f));
  m.doubleSided = true;
  const auto both = s.addMaterial(m);
  s.addBox({-0.4, 0, -0.3}, {0.5, 0.9, 0.6}, both, false);     // on the floor
  s.addBox({-1.4, 0.5, -0.3}, {-0.7, 0.9, 0.3}, both, false);  // in the air
  const BakedScene b(s.build(), test::quickOptions(500'000, 16));
  std::uint64_t backs = 0;
  for (const SideMaps& side : b.baked.maps.sides) {
    if (!side.back) continue;
    ++backs;
    EXPECT_FALSE(side.lit);
  }
  EXPECT_GE(backs, 12u);
}

TEST(Contacts, DoNotChangeLightThatIsTheSameOnBothSides) {
  SceneBuilder s;
  const auto lamp = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  s.addBox({-1, 0, -1}, {1, 1, 1}, lamp, true);
  for (const double turned : {1.0, -1.0})
    s.addQuad({0.02, 0, turned}, {0.02, 0, -turned}, {0.02, 1, -turned}, {0.02, 1, turned}, lamp);
  const BakedScene b(s.build(), test::quickOptions(2'000'000, 16));
  const double expected = std::numbers::pi * 100 / 0.5;
  double worst = 0;
  std::uint64_t texels = 0, cut = 0;
  forEachTexel(b, [&](const SideMaps& side, std::uint64_t t, double) {
    const SideContacts& contacts = (*b.baked.contacts)[static_cast<std::size_t>(&side - b.baked.maps.sides.data())];
    if (!contacts.empty() && contacts.share(t - side.firstTexel) == 0) ++cut;
    const double e = static_cast<double>(luminance(b.baked.maps.irradiance[t]));
    const double se = static_cast<double>(b.baked.maps.relativeError[t]) * std::sqrt(e * expected);
    worst = std::max(worst, std::abs(e - expected) / se);
    ++texels;
  });
  EXPECT_GT(cut, 32u);
  EXPECT_LT(worst, test::zThreshold(texels));
}

}  // namespace
}  // namespace lucarne::contacts_test
