// Mean directions of a bake: where light came from, exact bookkeeping, and nothing else touched.
#include <gtest/gtest.h>

#include "dlm/mean_direction.h"
#include "tests/app/bake_fixture.h"

namespace lucarne::moments_test {
namespace {

using test::BakedScene;
using test::SceneBuilder;

/// A black floor of 4 m, which needs no bounce, under a lamp.
Scene floorUnderLamp(Vec3d lamp) {
  SceneBuilder s;
  s.addQuad({-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, s.addDiffuse(Rgb(0.f)));
  Light light;
  light.kind = LightKind::point;
  light.position = lamp;
  light.intensity = Rgb(100.f);
  s.addLight(light);
  return s.build();
}

Scene room() {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.8f, 0.7f, 0.6f}), true);
  s.addBox({1, 0.2, 1}, {2, 1, 2.5}, s.addDiffuse({0.3f, 0.5f, 0.3f}), false);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

BakeOptions options(std::uint64_t photons = 100'000, bool moments = true) {
  BakeOptions o = test::quickOptions(photons, 4);
  o.threads = 2;
  o.keepAllDirections = true;
  o.moments = moments;
  return o;
}

/// The largest angle, as a cosine, between the stored mean directions of lit texels and those to the lamp from the texels'
/// middles; the floor lies in the plane y = 0.
double worstCosine(const BakedScene& b, Vec3d lamp) {
  const LightMaps& maps = b.baked.maps;
  double worst = 1;
  for (const SideMaps& side : maps.sides) {
    if (!side.lit) continue;
    const Chart& chart = b.plan.charts.charts[side.chart];
    const ChartLayout& layout = b.plan.layout.charts[side.chart];
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      const auto x = static_cast<double>(t % static_cast<std::uint64_t>(side.width)) + 0.5,
                 y = static_cast<double>(t / static_cast<std::uint64_t>(side.width)) + 0.5;
      // Of triangle corners: uv and place go together linearly.
      const std::uint32_t triangle = chart.triangles[0];
      const auto& uv = b.plan.charts.cornerUv[triangle];
      const Vec2d p{x / layout.texelsPerLocal.x, y / layout.texelsPerLocal.y};
      const Vec2d e1 = Vec2d{uv[1].x, uv[1].y} - Vec2d{uv[0].x, uv[0].y}, e2 = Vec2d{uv[2].x, uv[2].y} - Vec2d{uv[0].x, uv[0].y},
                  d = p - Vec2d{uv[0].x, uv[0].y};
      const double det = e1.x * e2.y - e1.y * e2.x, u = (d.x * e2.y - d.y * e2.x) / det, v = (e1.x * d.y - e1.y * d.x) / det;
      const auto corner = [&](std::size_t k) { return Vec3d(b.scene.positions[b.scene.triangles[triangle].v[k]]); };
      const Vec3d local = corner(0) + (corner(1) - corner(0)) * u + (corner(2) - corner(0)) * v;
      const Vec3d toLamp = normalize((lamp - b.scene.frame.origin) / b.scene.frame.scale - local);
      double brightest = 0;
      Vec3f mean{};
      for (const SideDirection& s : side.directions) {
        if (!s.stored()) continue;
        const double light = static_cast<double>(luminance(maps.directional[s.first + t]));
        if (light > brightest) brightest = light, mean = maps.meanDirections[s.first + t];
      }
      if (brightest > 0) worst = std::min(worst, dot(normalize(Vec3d(mean)), toLamp));
    }
  }
  return worst;
}

TEST(Moments, TheDirectionToALampComesBack) {
  const Vec3d lamp{0.3, 1.5, -0.4};
  for (const int directions : {1, 5, 14, 64}) {
    BakeOptions o = options();
    o.directions = directions;
    const BakedScene b(floorUnderLamp(lamp), o);
    ASSERT_TRUE(b.baked.maps.hasMeans());
    // Texels of 25 cm and a kernel of three: 12 degrees under the lamp at most. Cells of 14 directions are 30 wide.
    EXPECT_GT(worstCosine(b, lamp), 0.97) << directions;
  }
}

TEST(Moments, GatheredLightBringsThemToo) {
  const Vec3d lamp{0.3, 1.5, -0.4};
  BakeOptions o = options();
  o.direct = DirectMode::gathered;
  o.directSamples = 32;
  const BakedScene b(floorUnderLamp(lamp), o);
  ASSERT_TRUE(b.baked.maps.hasMeans());
  EXPECT_GT(worstCosine(b, lamp), 0.97);
}

Tallies talliesOf(const Scene& scene, const BakeOptions& o) {
  const PhotonScene photonScene(scene);
  const BakePlan plan = makePlan(scene, o);
  Tallies tallies(plan.tallies, tallySets(o));
  const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
  Ledger ledger;
  runPhotons({photonScene, map, plan.tallies, plan.directions}, {0, o.photons}, runOptions(o), tallies, ledger,
             [](const RunProgress&) { return true; });
  return tallies;
}

TEST(Moments, LeaveTheLightAsItIs) {
  const Scene scene = room();
  const Tallies with = talliesOf(scene, options()), without = talliesOf(scene, options(100'000, false));
  EXPECT_TRUE(without.moments().empty());
  EXPECT_FALSE(with.moments().empty());
  EXPECT_TRUE(std::ranges::equal(with.light(), without.light()));
  EXPECT_TRUE(std::ranges::equal(with.statistics(), without.statistics()));
  EXPECT_NE(with.contentHash(), without.contentHash());
}

TEST(Moments, AreBetweenNothingAndTheLuminance) {
  const Scene scene = room();
  const BakeOptions o = options();
  const Tallies tallies = talliesOf(scene, o);
  const BakePlan plan = makePlan(scene, o);
  ASSERT_EQ(plan.tallies.momentEntries, plan.tallies.lightEntries);  // all sides have directions
  std::uint64_t lit = 0;
  for (std::uint64_t e = 0; e < plan.tallies.momentEntries; ++e) {
    const auto light = tallies.light().subspan(3 * e, 3), moment = tallies.moments().subspan(3 * e, 3);
    const double l = luminance(Rgbd{static_cast<double>(light[0]), static_cast<double>(light[1]), static_cast<double>(light[2])});
    double square = 0;
    for (const std::int64_t m : moment) {
      ASSERT_GE(m, 0);
      ASSERT_LE(static_cast<double>(m), l * (1 + 1e-6) + 100);
      square += l > 0 ? std::pow(2 * static_cast<double>(m) / l - 1, 2) : 0;
    }
    if (l < 1e6) continue;
    ++lit;
    ASSERT_LE(square, 1.001);
  }
  EXPECT_GT(lit, 1000u);
}

TEST(Moments, OneTwoAndSevenThreadsGiveTheSameHash) {
  const Scene scene = room();
  const auto hash = [&](int threads, bool own) {
    BakeOptions o = options(50'000);
    o.threads = threads;
    o.ownTallies = own;
    return talliesOf(scene, o).contentHash();
  };
  const Hash128 one = hash(1, true);
  EXPECT_EQ(one, hash(2, true));
  EXPECT_EQ(one, hash(7, true));
  EXPECT_EQ(one, hash(3, false));
}

TEST(Moments, SidesWithoutDirectionsHaveNone) {
  BakeOptions o = options();
  o.keepAllDirections = false;
  EXPECT_EQ(makePlan(room(), o).tallies.momentEntries, 0u);
  EXPECT_FALSE(BakedScene(room(), o).baked.maps.hasMeans());
}

}  // namespace
}  // namespace lucarne::moments_test
