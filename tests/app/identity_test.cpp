// Identities of a bake: exact, not statistical.
#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tracer/transport/any_sink.h"

namespace lucarne::identity_test {
namespace {

using test::BakedScene;
using test::SceneBuilder;

SceneBuilder furnishedRoom() {
  SceneBuilder s;
  Material glossy = test::diffuseMaterial({0.3f, 0.2f, 0.1f});
  glossy.specular = 1;
  glossy.roughness = 0.4671f;
  glossy.doubleSided = true;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.8f, 0.7f, 0.6f}), true);
  s.addBox({1, 0.2, 1}, {2, 1, 2.5}, s.addMaterial(glossy), false);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s;
}

BakeOptions options(int threads, std::uint64_t seed) {
  BakeOptions o = test::quickOptions(100'000, 8);
  o.threads = threads;
  o.seed = seed;
  return o;
}

TEST(Identity, OneTwoAndSevenThreadsGiveTheSameHash) {
  const Scene scene = furnishedRoom().build();
  const Hash128 one = BakedScene(scene, options(1, 0)).baked.contentHash;
  EXPECT_EQ(one, BakedScene(scene, options(2, 0)).baked.contentHash);
  EXPECT_EQ(one, BakedScene(scene, options(7, 0)).baked.contentHash);
}

TEST(Identity, AnotherSeedGivesAnotherHash) {
  const Scene scene = furnishedRoom().build();
  EXPECT_NE(BakedScene(scene, options(2, 0)).baked.contentHash, BakedScene(scene, options(2, 1)).baked.contentHash);
}

TEST(Identity, SharedAndPrivateTalliesAgree) {
  const Scene scene = furnishedRoom().build();
  const PhotonScene photonScene(scene);
  const BakePlan plan = makePlan(scene, options(3, 0));
  const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
  const auto run = [&](std::uint64_t privateBytes) {
    PhotonRunOptions o;
    o.threads = 3;
    o.privateTallyBytes = privateBytes;
    Tallies tallies(plan.tallies);
    Ledger ledger;
    runPhotons({photonScene, map, plan.tallies, plan.directions}, {0, 50'000}, o, tallies, ledger, [](const RunProgress&) { return true; });
    return tallies.contentHash();
  };
  EXPECT_EQ(run(0), run(std::uint64_t{1} << 40));
}

/// Sums what it is handed, chart side by chart side, apart from all tally code.
struct SummingSink {
  DepositSink<false>& inner;
  std::vector<FluxSum> byTriangleSide;
  void hit(const PhotonHit& h) {
    const FluxSum before = inner.sums().incident;
    inner.hit(h);
    FluxSum& sum = byTriangleSide[2 * h.hit.triangle + h.hit.back];
    for (std::size_t c = 0; c < 3; ++c) sum.units[c] += inner.sums().incident.units[c] - before.units[c];
  }
  void endPhoton() { inner.endPhoton(); }
};

TEST(Identity, ChartTotalsOfTheTalliesAreTheIncidentFluxExactly) {
  const Scene scene = furnishedRoom().build();
  const PhotonScene photonScene(scene);
  const BakePlan plan = makePlan(scene, options(1, 0));
  const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
  const Tallies tallies(plan.tallies);
  DepositSink<false> inner(map, plan.tallies, plan.directions, LightPart::all, tallies);
  SummingSink sink{inner, std::vector<FluxSum>(2 * scene.triangles.size())};
  Ledger ledger;
  flyPhotons(photonScene, {0, 50'000}, 3, {}, sink, ledger);
  inner.flush();
  std::vector<FluxSum> bySide(plan.tallies.sides.size());
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (const bool back : {false, true}) {
      const std::uint32_t side = (back ? plan.tallies.backSide : plan.tallies.frontSide)[plan.charts.chartOfTriangle[t]];
      if (side != kNone) bySide[side] += sink.byTriangleSide[2 * t + back];
    }
  Int128 total = 0;
  for (std::size_t s = 0; s < bySide.size(); ++s) {
    const TallySide& side = plan.tallies.sides[s];
    FluxSum sum;
    const std::uint64_t entries = side.texelCount() * plan.tallies.membersOf(side).mapCount();
    for (std::uint64_t k = 0; k < entries * 3; ++k) sum.units[k % 3] += tallies.light()[side.firstLight * 3 + k];
    EXPECT_TRUE(sum == bySide[s]) << "side " << s;
    total += sum.units[0];
  }
  EXPECT_TRUE(total == inner.sums().incident.units[0]);
  EXPECT_GT(inner.sums().storedHits, 50'000u);
}

TEST(Identity, LightPartsAddUpToAll) {
  const Scene scene = furnishedRoom().build();
  const auto incident = [&](LightPart part) {
    BakeOptions o = options(1, 0);
    o.light = part;
    return BakedScene(scene, o).baked.ledger.incident;
  };
  FluxSum sum = incident(LightPart::direct);
  sum += incident(LightPart::indirect);
  EXPECT_TRUE(sum == incident(LightPart::all));
}

TEST(Identity, DirectionsAddUpToTheIrradianceTexelByTexel) {
  BakeOptions o = options(2, 0);
  o.keepAllDirections = true;
  const BakedScene b(furnishedRoom().build(), o);
  const LightMaps& maps = b.baked.maps;
  for (const SideMaps& side : maps.sides) {
    for (std::uint64_t t = 0; side.lit && t < side.texelCount(); ++t) {
      Rgbd sum{};
      for (const SideDirection& d : side.directions)
        if (d.stored()) sum += Rgbd(maps.directional[d.first + t]);
      const Rgb e = maps.irradiance[side.firstTexel + t];
      ASSERT_NEAR(sum.y, static_cast<double>(e.y), 1e-5 * static_cast<double>(e.y) + 1e-30);
    }
  }
}

TEST(Identity, ASceneWithoutLightBakesToBlack) {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {1, 1, 1}, s.addDiffuse(Rgb(0.5f)), true);
  const BakedScene b(s.build(), options(2, 0));
  EXPECT_EQ(b.baked.ledger.photons, 0u);
  for (const SideMaps& side : b.baked.maps.sides) EXPECT_FALSE(side.lit);
}

}  // namespace
}  // namespace lucarne::identity_test
