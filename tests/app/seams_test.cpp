// Charts that continue each other agree along their seams.
#include "dlm/seam_fit.h"

#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tests/support/smooth_sphere.h"

namespace lucarne::seams_test {
namespace {

using test::BakedScene;
using test::SceneBuilder;

/// A floor of two materials side by side, a joint between them at x = 0.037; a lamp above.
SceneBuilder joinedFloor(bool glossy) {
  SceneBuilder s;
  Material m = test::diffuseMaterial({0.6f, 0.5f, 0.4f}), n = test::diffuseMaterial({0.2f, 0.3f, 0.4f});
  if (glossy) m.specular = n.specular = 1, m.roughness = n.roughness = 0.4f;
  const auto a = s.addMaterial(m), b = s.addMaterial(n);
  s.addQuad({-1, 0, 1}, {0.037, 0, 1}, {0.037, 0, -1}, {-1, 0, -1}, a);
  s.addQuad({0.037, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0.037, 0, -1}, b);
  s.addQuad({-0.5, 0.6, -0.5}, {0.6, 0.6, -0.5}, {0.6, 0.6, 0.6}, {-0.5, 0.6, 0.6},
            s.addDiffuse(Rgb(0.5f), {100, 80, 60}));
  return s;
}

BakeOptions optionsWith(SeamMode seams) {
  BakeOptions o = test::quickOptions(200'000, 11);
  o.seams = seams;
  return o;
}

TEST(Seams, OfAFlatFloorAreFound) {
  const BakedScene b(joinedFloor(false).build(), optionsWith(SeamMode::keep));
  EXPECT_EQ(b.baked.seams.seams, 1u);
  EXPECT_NEAR(b.baked.seams.length, 2, 1e-6);
  EXPECT_GT(b.baked.seams.jumpBefore, 0.01);
  EXPECT_EQ(b.baked.seams.jumpBefore, b.baked.seams.jumpAfter);
}

TEST(Seams, OfARoomsCornersAreNone) {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {1, 1, 1}, s.addDiffuse(Rgb(0.5f), Rgb(10.f)), true);
  EXPECT_EQ(BakedScene(s.build(), optionsWith(SeamMode::fit)).baked.seams.seams, 0u);
}

TEST(Seams, UnderAWallAreNone) {
  SceneBuilder s = joinedFloor(false);
  const auto m = s.addDiffuse(Rgb(0.5f));
  for (const double turned : {1.0, -1.0})  // a wall without thickness, its foot longer than the joint
    s.addQuad({0.037, 0, 1.1 * turned}, {0.037, 0, -1.1 * turned}, {0.037, 0.3, -1.1 * turned},
              {0.037, 0.3, 1.1 * turned}, m);
  EXPECT_EQ(BakedScene(s.build(), optionsWith(SeamMode::fit)).baked.seams.seams, 0u);
}

TEST(SeamFit, TakesTheJumpAwayAndKeepsTheFlux) {
  const BakedScene b(joinedFloor(false).build(), optionsWith(SeamMode::fit));
  const SeamReport& r = b.baked.seams;
  EXPECT_LT(r.jumpAfter, 0.2 * r.jumpBefore);
  EXPECT_LT(r.worstAfter, 0.2 * r.worstBefore);
  EXPECT_LT(std::abs(r.fluxChange), 1e-4);
}

TEST(SeamFit, OfASphereLeavesNoFacets) {
  SceneBuilder s;
  s.addBox({-1, -1, -1}, {1, 1, 1}, s.addDiffuse(Rgb(0.3f), Rgb(20.f)), true);
  s.addQuad({-0.3, 0.9, -0.3}, {0.3, 0.9, -0.3}, {0.3, 0.9, 0.3}, {-0.3, 0.9, 0.3}, s.addDiffuse(Rgb(0.f), Rgb(900.f)));
  const auto ball = s.addDiffuse(Rgb(0.5f));
  test::addSphere(s, {0, -0.1, 0}, 0.4, ball, 8);
  Scene scene = s.build();
  test::smoothen(scene, ball, {0, -0.1, 0});
  const BakedScene b(scene, optionsWith(SeamMode::fit));
  EXPECT_GT(b.baked.seams.seams, 20u);
  EXPECT_LT(b.baked.seams.jumpAfter, 0.2 * b.baked.seams.jumpBefore);
}

// What the fit does far from the seam: nothing.
TEST(SeamFit, ChangesNothingButTexelsAtSeams) {
  const BakedScene fitted(joinedFloor(false).build(), optionsWith(SeamMode::fit)),
      kept(joinedFloor(false).build(), optionsWith(SeamMode::keep));
  const SideMaps& side = fitted.baked.maps.sides[0];
  std::size_t changed = 0;
  for (std::uint64_t t = 0; t < side.texelCount(); ++t)
    changed +=
        fitted.baked.maps.irradiance[side.firstTexel + t] == kept.baked.maps.irradiance[side.firstTexel + t] ? 0 : 1;
  EXPECT_GT(changed, 0u);
  EXPECT_LE(changed, 2u * static_cast<std::size_t>(std::max(side.width, side.height)));
}

TEST(SeamFit, LightByDirectionStillSumsToTheIrradiance) {
  const BakedScene fitted(joinedFloor(true).build(), optionsWith(SeamMode::fit)),
      kept(joinedFloor(true).build(), optionsWith(SeamMode::keep));
  EXPECT_NE(fitted.baked.maps.directional, kept.baked.maps.directional);
  EXPECT_LT(fitted.baked.seams.jumpAfter, 0.2 * fitted.baked.seams.jumpBefore);
  const LightMaps& maps = fitted.baked.maps;
  std::size_t sides = 0;
  for (const SideMaps& side : maps.sides) {
    if (!side.lit || side.directions.empty()) continue;
    ++sides;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      Rgbd sum{};
      for (const SideDirection& d : side.directions)
        if (d.stored()) sum += Rgbd(maps.directional[d.first + t]);
      const Rgbd e(maps.irradiance[side.firstTexel + t]);
      EXPECT_NEAR(sum.y, e.y, 1e-5 * e.y + 1e-6);
    }
  }
  EXPECT_GE(sides, 2u);
}

// Jumps of the light from single directions, too.
TEST(SeamFit, ReachesLightByDirection) {
  const auto jump = [](SeamMode mode) {
    const BakedScene b(joinedFloor(true).build(), optionsWith(mode));
    const LightMaps& maps = b.baked.maps;
    double difference = 0, mean = 0;
    const SeamSet set = findSeams(b.scene, b.plan.charts, b.plan.layout, maps, *b.baked.contacts);
    for (const SeamSample& s : set.samples) {
      const SideMaps &a = maps.sides[s.sideA], &c = maps.sides[s.sideB];
      for (std::size_t k = 0; k < std::min(a.directions.size(), c.directions.size()); ++k) {
        if (!a.directions[k].stored() || !c.directions[k].stored()) continue;
        const auto read = [&maps](const SideDirection& d, const SideLookup& look) {
          double sum = 0;
          for (std::size_t i = 0; i < 4; ++i)
            sum += look.weight[i] * static_cast<double>(luminance(maps.directional[d.first + look.texel[i]]));
          return sum;
        };
        const double x = read(a.directions[k], s.a), y = read(c.directions[k], s.b);
        difference += (x - y) * (x - y);
        mean += 0.25 * (x + y) * (x + y);
      }
    }
    return std::sqrt(difference / mean);
  };
  EXPECT_LT(jump(SeamMode::fit), 0.3 * jump(SeamMode::keep));
}

}  // namespace
}  // namespace lucarne::seams_test
