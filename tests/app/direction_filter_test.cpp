// --direction-filter linear: hits shared among three directions, and nothing else changed.
#include <gtest/gtest.h>

#include "dlm/direction_shares.h"
#include "tests/app/bake_fixture.h"

namespace lucarne::direction_filter_test {
namespace {

using test::BakedScene;
using test::SceneBuilder;

Scene roomWithBoxes() {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.8f, 0.7f, 0.6f}), true);
  s.addBox({1, 0.2, 1}, {2, 1, 2.5}, s.addDiffuse({0.3f, 0.5f, 0.3f}), false);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

BakeOptions filtered(DirectionFilter filter, int directions = 14) {
  BakeOptions o = test::quickOptions(50'000, 4);
  o.threads = 2;
  o.directions = directions;
  o.keepAllDirections = true;
  o.directionFilter = filter;
  return o;
}

struct Counted {
  BakePlan plan;
  Tallies tallies;
  Ledger ledger;
};

Counted countPhotons(const Scene& scene, const BakeOptions& o) {
  const PhotonScene photonScene(scene);
  BakePlan plan = makePlan(scene, o);
  Tallies tallies(plan.tallies, tallySets(o));
  if (gathersDirect(o))
    DirectGather({photonScene, plan.charts, plan.layout, plan.tallies, plan.directions}, {o.seed, o.sampler})
        .gather({0, o.directSamples}, tallies);
  const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
  Ledger ledger;
  runPhotons({photonScene, map, plan.tallies, plan.directions}, {0, o.photons}, runOptions(o), tallies, ledger,
             [](const RunProgress&) { return true; });
  return {std::move(plan), std::move(tallies), ledger};
}

/// Σ over ψ of every texel's channels, of the light or the moments.
std::vector<std::int64_t> overDirections(const BakePlan& plan, std::span<const std::int64_t> tally) {
  std::vector<std::int64_t> sums(3 * plan.tallies.texels);
  for (const TallySide& side : plan.tallies.sides)
    for (std::uint64_t k = 0; k < plan.tallies.membersOf(side).mapCount(); ++k)
      for (std::uint64_t i = 0; i < 3 * side.texelCount(); ++i)
        sums[3 * side.firstTexel + i] += tally[3 * (side.firstLight + k * side.texelCount()) + i];
  return sums;
}

class DirectionFilterOf : public ::testing::TestWithParam<DirectMode> {};

TEST_P(DirectionFilterOf, AnyKindLeavesEveryTexelItsLightItsStatisticsAndItsMoment) {
  const Scene scene = roomWithBoxes();
  BakeOptions o = filtered(DirectionFilter::nearest), shared = filtered(DirectionFilter::linear);
  o.moments = shared.moments = true;
  o.direct = shared.direct = GetParam();
  o.directSamples = shared.directSamples = 6;
  const Counted nearest = countPhotons(scene, o), linear = countPhotons(scene, shared);
  ASSERT_EQ(nearest.plan.tallies.momentEntries, nearest.plan.tallies.lightEntries);  // all sides have directions
  EXPECT_FALSE(std::ranges::equal(nearest.tallies.light(), linear.tallies.light()));
  const auto expectSame = [&](const Tallies& a, const Tallies& b) {
    EXPECT_EQ(overDirections(nearest.plan, a.light()), overDirections(linear.plan, b.light()));
    EXPECT_EQ(overDirections(nearest.plan, a.moments()), overDirections(linear.plan, b.moments()));
    EXPECT_TRUE(std::ranges::equal(a.statistics(), b.statistics()));
    EXPECT_TRUE(std::ranges::all_of(b.light(), [](std::int64_t v) { return v >= 0; }));
    EXPECT_TRUE(std::ranges::all_of(b.moments(), [](std::int64_t v) { return v >= 0; }));
  };
  expectSame(nearest.tallies, linear.tallies);
  if (GetParam() == DirectMode::gathered) expectSame(*nearest.tallies.direct(), *linear.tallies.direct());
  EXPECT_TRUE(nearest.ledger.incident == linear.ledger.incident);
  EXPECT_EQ(nearest.ledger.storedHits, linear.ledger.storedHits);
}
INSTANTIATE_TEST_SUITE_P(Light, DirectionFilterOf, ::testing::Values(DirectMode::photons, DirectMode::gathered),
                         [](const auto& mode) { return mode.param == DirectMode::photons ? "photons" : "gathered"; });

TEST(LinearFilter, OneTwoAndSevenThreadsGiveTheSameHash) {
  const Scene scene = roomWithBoxes();
  const auto hash = [&](int threads, bool own) {
    BakeOptions o = filtered(DirectionFilter::linear);
    o.threads = threads;
    o.ownTallies = own;
    return countPhotons(scene, o).tallies.contentHash();
  };
  const Hash128 one = hash(1, true);
  EXPECT_EQ(one, hash(2, true));
  EXPECT_EQ(one, hash(7, true));
  EXPECT_EQ(one, hash(3, false));
}

TEST(LinearFilter, WithFewerThanFourDirectionsIsTheOther) {
  const Scene scene = roomWithBoxes();
  EXPECT_EQ(countPhotons(scene, filtered(DirectionFilter::nearest, 3)).tallies.contentHash(),
            countPhotons(scene, filtered(DirectionFilter::linear, 3)).tallies.contentHash());
}

TEST(LinearFilter, ASunIsProbedInTheThreeDirectionsAroundItByTheirWeights) {
  for (int i = 0; i < 8; ++i) {
    const double height = 0.1 + 0.11 * i, angle = 2.4 * i, r = std::sqrt(1 - height * height);
    SceneBuilder s;
    s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, s.addDiffuse(Rgb(0.3f)));
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = -Vec3d{r * std::cos(angle), height, r * std::sin(angle)};
    sun.intensity = Rgb(1000.f);
    s.addLight(sun);
    BakeOptions o = filtered(DirectionFilter::linear, 64);
    o.light = LightPart::direct;
    const BakedScene b(s.build(), o);
    const DirectionShares shares =
        directionShares(b.plan.directions, b.plan.tallies.membersOf(b.plan.tallies.sides.at(0)), -Vec3f(sun.direction));
    const ProbeAnswer answer = test::ProbedBake(b, "linear_sun").at({0.1, 0, 0.2}, {0, 1, 0});
    std::vector<double> expected(answer.directions.size());
    std::uint32_t before = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      expected.at(shares.rank[k]) += (shares.upTo[k] - before) / double{DirectionWeights::kWhole};
      before = shares.upTo[k];
    }
    double cosines = 0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(answer.directions[k].irradiance.y, expected[k] * answer.irradiance.y, 1e-5 * answer.irradiance.y)
          << k;
      cosines += answer.directions[k].solidAngle * answer.directions[k].meanCosine;
    }
    EXPECT_NEAR(cosines, 3.14159265, 1e-4);  // what is told of the directions is of their tents
  }
}

/// In a black furnace every photon ends at its first wall and carries the same: what a tent holds of N photons has the
/// mean N·p·E[λ] and at most the variance of as many whole ones.
TEST(LinearFilter, ConstantLightFillsEveryTentByItsCosineIntegral) {
  constexpr std::uint64_t kPhotons = 2'000'000;
  for (const int directions : {14, 64}) {
    SceneBuilder s;
    s.addBox({-1, 0, -1}, {1, 1.5, 1}, s.addDiffuse(Rgb(0.f), Rgb(100.f)), true);
    BakeOptions o = filtered(DirectionFilter::linear, directions);
    o.photons = kPhotons;
    o.texelsPerMetre = 1e-3;  // a texel a wall
    o.kernel.width = 0.5;
    const BakedScene b(s.build(), o);
    double worst = 0;
    std::uint64_t questions = 0;
    for (const SideMaps& side : b.baked.maps.sides) {
      const Vec3d n(b.baked.maps.charts[side.chart].normal);
      const std::uint64_t first = b.plan.layout.charts[side.chart].firstTexel;
      const double square = b.scene.frame.scale * b.scene.frame.scale;
      for (const SideDirection& d : side.directions) {
        const double expected = 100 * b.plan.directions.clippedCell(d.psi, n).cosIntegral;
        const double count = expected * b.plan.layout.area[first] * square / b.baked.emittedFlux * kPhotons;
        const double value = d.stored() ? static_cast<double>(b.baked.maps.directional[d.first].y) : 0;
        if (count < 25) continue;
        worst = std::max(worst, std::abs(value / expected - 1) * std::sqrt(count));
        ++questions;
      }
    }
    EXPECT_GT(questions, static_cast<std::uint64_t>(6 * directions / 2));
    EXPECT_LT(worst, test::zThreshold(questions)) << directions;
  }
}

}  // namespace
}  // namespace lucarne::direction_filter_test
