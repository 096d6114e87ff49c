// Guides change how light from far away is sampled, not what it gives.
#include "tracer/optics/emission_guide.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "tests/app/truth_scenes.h"
#include "tests/tracer/photon_runs.h"
#include "tracer/transport/guide_pilot.h"

namespace lucarne::emission_guide_test {
namespace {

using test::FluxMeter;

/// Random usefulness, a third of it 0, some cells a hundred times as useful.
EmissionGuide guideOf(GuideGrid grid) {
  std::mt19937 random(3);
  std::vector<double> usefulness(grid.cells());
  for (double& u : usefulness) {
    u = random() % 3 == 0 ? 0.0 : static_cast<double>(random() % 1000) / 1000;
    if (random() % 10 == 0) u *= 100;
  }
  return {grid, usefulness};
}

struct Numbers {
  Vec2f direction, place;
};
Numbers numbersOf(std::uint64_t i) {
  const auto u = PhotonSampler(9, i).floats(0, Stream::emission);
  return {{u[0], u[1]}, {u[2], u[3]}};
}

TEST(EmissionGuide, DensityIsNowhereBelowAQuarterAndOneOnAverage) {
  for (const GuideGrid grid : {GuideGrid{1, 64}, GuideGrid{8, 16}, GuideGrid{2, 3}, GuideGrid{1, 1}}) {
    const EmissionGuide guide = guideOf(grid);
    double sum = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
      EXPECT_GE(guide.densityOf(c), 0.25 * (1 - 1e-4));
      sum += guide.densityOf(c);
    }
    EXPECT_NEAR(sum / static_cast<double>(grid.cells()), 1, 1e-9);
  }
  std::vector<double> one(16);
  one[5] = 1;  // all light through one cell
  EXPECT_GE(EmissionGuide({1, 4}, one).densityOf(0), 0.25 * (1 - 1e-4));
}

TEST(EmissionGuide, WarpKeepsTheOrderOnEachAxis) {
  const EmissionGuide guide = guideOf({4, 5});
  for (std::uint64_t k = 0; k < 50; ++k) {
    const Numbers u = numbersOf(k);
    for (int axis = 0; axis < 4; ++axis) {
      float last = -1;
      for (int i = 0; i < 500; ++i) {
        Numbers v = u;
        float& moved = axis == 0 ? v.direction.x : axis == 1 ? v.direction.y : axis == 2 ? v.place.x : v.place.y;
        moved = static_cast<float>(i) / 500;
        const EmissionGuide::Numbers w = guide.warp(v.direction, v.place);
        const float at = axis == 0 ? w.direction.x : axis == 1 ? w.direction.y : axis == 2 ? w.place.x : w.place.y;
        ASSERT_GE(at, last);
        ASSERT_LT(at, 1);
        last = at;
      }
    }
  }
}

/// Warped numbers by cell, and how many were weighted by another cell's density.
struct Warped {
  std::vector<double> counts;
  std::uint64_t strays = 0;
};
Warped warped(const EmissionGuide& guide, std::uint64_t samples) {
  Warped result{std::vector<double>(guide.grid().cells()), 0};
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Numbers u = numbersOf(i);
    const EmissionGuide::Numbers w = guide.warp(u.direction, u.place);
    const std::size_t cell = guide.cellOf(w.direction, w.place);
    ++result.counts[cell];
    result.strays += w.density != guide.densityOf(cell);
  }
  return result;
}

TEST(EmissionGuide, WarpedNumbersFollowTheDensity) {
  const EmissionGuide guide = guideOf({3, 4});
  constexpr std::uint64_t kSamples = 500'000;
  const Warped w = warped(guide, kSamples);
  std::vector<double> expected, wrong;
  for (std::size_t c = 0; c < guide.grid().cells(); ++c) {
    expected.push_back(kSamples * guide.densityOf(c) / static_cast<double>(guide.grid().cells()));
    wrong.push_back(kSamples * guideOf({3, 4}).densityOf((c + 1) % guide.grid().cells()) /
                    static_cast<double>(guide.grid().cells()));
  }
  EXPECT_GT(test::chiSquareP(w.counts, expected), 1e-4);
  EXPECT_LT(test::chiSquareP(w.counts, wrong), 1e-4) << "a wrong density is seen";
  // A number may be rounded onto the border to the next cell; its density is still that of its own.
  EXPECT_LT(w.strays, kSamples / 10'000);
}

TEST(EmissionGuide, WarpedNumbersAreUniformWithinACell) {
  const EmissionGuide guide = guideOf({1, 4});
  constexpr int kParts = 5;
  std::vector<double> counts(16 * kParts * kParts), expected(counts.size());
  constexpr std::uint64_t kSamples = 300'000;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const Numbers u = numbersOf(i);
    const EmissionGuide::Numbers w = guide.warp(u.direction, u.place);
    const auto fine = [](float x) { return static_cast<std::size_t>(x * 4 * kParts); };
    ++counts[fine(w.place.x) * 4 * kParts + fine(w.place.y)];
  }
  for (std::size_t x = 0; x < 4 * kParts; ++x)
    for (std::size_t y = 0; y < 4 * kParts; ++y)
      expected[x * 4 * kParts + y] = kSamples * guide.densityOf(x / kParts * 4 + y / kParts) / (16 * kParts * kParts);
  EXPECT_GT(test::chiSquareP(counts, expected), 1e-4);
}

TEST(EmissionGuide, MeansAreWhatTheyAreWithoutIt) {
  const EmissionGuide guide = guideOf({4, 4});
  const auto f = [](Vec2f d, Vec2f p) {
    return static_cast<double>(d.x * d.x + 3 * d.y * p.x + p.y * p.y * p.y);  // 1/3 + 3/4 + 1/4
  };
  test::Mean guided;
  for (std::uint64_t i = 0; i < 300'000; ++i) {
    const Numbers u = numbersOf(i);
    const EmissionGuide::Numbers w = guide.warp(u.direction, u.place);
    guided.add(f(w.direction, w.place) / w.density);
  }
  test::expectMean(guided, 1.0 / 3 + 0.75 + 0.25, 1);
}

std::vector<Hash128> learn(PhotonScene& scene, int threads, std::vector<GuidePilotResult>* results = nullptr) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const std::vector<GuidePilotResult> found = learnGuides(scene, {.seed = 4, .photons = 1u << 16});
  if (results != nullptr) *results = found;
  std::vector<Hash128> hashes;
  for (const EmissionGuide& g : scene.emitters().guides()) hashes.push_back(g.hash());
  return hashes;
}

TEST(GuidePilot, FindsTheWindowAndLearnsTheSameWithAnyNumberOfThreads) {
  const Scene room = test::windowRoom();
  const auto sky = test::sunnySky();
  PhotonScene one(room, {}, sky.get()), two(room, {}, sky.get());
  std::vector<GuidePilotResult> results;
  const std::vector<Hash128> hashes = learn(one, 1, &results);
  ASSERT_EQ(hashes.size(), 1u);
  EXPECT_EQ(hashes, learn(two, 2));
  ASSERT_EQ(results.size(), 1u);
  EXPECT_TRUE(results[0].guided);
  EXPECT_GT(results[0].wasted, 0.5);
  EXPECT_GT(results[0].gain, 1.1);
}

TEST(GuidePilot, LeavesAloneWhatAGuideDoesNotHelp) {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {1, 1, 1}, b.addDiffuse(Rgb(0.5f)), false);
  b.addLight(test::bulbLight({3, 3, 3}, Rgb(10.f)));
  const Scene scene = b.build();
  PhotonScene photons(scene);
  EXPECT_TRUE(learnGuides(photons, {}).empty()) << "no light from far away";
  EXPECT_TRUE(photons.emitters().guides().empty());
}

TEST(GuidePilot, GuidedFluxOnEveryWallIsTheUnguidedOneWithLessNoise) {
  const Scene room = test::windowRoom();
  const auto sky = test::sunnySky();
  const PhotonScene plain(room, {}, sky.get());
  PhotonScene guided(room, {}, sky.get());
  learn(guided, 2);
  const auto place = [](const PhotonHit& h) { return h.hit.triangle / 2; };
  const std::size_t walls = room.triangles.size() / 2;
  FluxMeter plainFlux(walls, place), guidedFlux(walls, place);
  const Ledger plainLedger = test::fly(plain, 200'000, plainFlux, 1),
               guidedLedger = test::fly(guided, 200'000, guidedFlux, 2);
  test::expectBalance(plainLedger);
  test::expectBalance(guidedLedger);
  double plainVariance = 0, guidedVariance = 0;
  for (std::size_t w = 0; w < walls; ++w) {
    const double se = std::hypot(plainFlux[w].error(), guidedFlux[w].error());
    EXPECT_NEAR(guidedFlux[w].mean(), plainFlux[w].mean(), test::zThreshold(walls) * se) << w;
    plainVariance += plainFlux[w].variance();
    guidedVariance += guidedFlux[w].variance();
  }
  const double cost = static_cast<double>(guidedLedger.rays) / static_cast<double>(plainLedger.rays);
  EXPECT_LT(guidedVariance * cost, plainVariance / 1.1);
}

TEST(GuidePilot, NoGuidedPhotonWeighsMoreThanFourTimesAnUnguidedOne) {
  const Scene room = test::windowRoom();
  const auto sky = test::sunnySky(1e6f);
  PhotonScene guided(room, {}, sky.get());
  learn(guided, 2);
  ASSERT_EQ(guided.emitters().guides().size(), 1u);
  float largest = 0;
  for (std::uint64_t i = 0; i < 200'000; ++i)
    largest = std::max(largest, maxComponent(guided.emitters().sample(PhotonSampler(2, i).emission()).beta));
  EXPECT_LE(largest, 3 * 4 * 1.001f);
}

}  // namespace
}  // namespace lucarne::emission_guide_test
