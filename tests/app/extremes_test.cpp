// Bakes at the ends of every range: sizes, flux, albedo, directions, texels, photons, indices, places.
#include <gtest/gtest.h>

#include <limits>

#include "dlm/resolve.h"
#include "tests/app/deviation.h"

namespace lucarne::extremes_test {
namespace {

using test::BakedScene;
using test::deviationFrom;
using test::fraction;
using test::kPi64;
using test::ProbedBake;
using test::SceneBuilder;

/// A closed box of 2 × 1.3 × 1.7 times `size`, all walls alike.
Scene furnace(double size, float albedo, Rgb emission, Vec3d at = {}) {
  SceneBuilder s;
  s.addBox(at, at + Vec3d{2, 1.3, 1.7} * size, s.addDiffuse(Rgb(albedo), emission), true);
  return s.build();
}

BakedScene bakeFurnace(double size, Rgb emission, std::uint64_t photons = 300'000) {
  return BakedScene(furnace(size, 0.5f, emission), test::quickOptions(photons, 8 / size));
}

void expectScaled(const BakedScene& b, const BakedScene& reference, double factor) {
  EXPECT_EQ(b.baked.contentHash, reference.baked.contentHash);
  ASSERT_EQ(b.baked.maps.irradiance.size(), reference.baked.maps.irradiance.size());
  for (std::size_t t = 0; t < b.baked.maps.irradiance.size(); ++t)
    ASSERT_EQ(Rgbd(b.baked.maps.irradiance[t]), Rgbd(reference.baked.maps.irradiance[t]) * factor) << "texel " << t;
}

class Scale : public testing::TestWithParam<double> {};

TEST_P(Scale, AFurnaceReadsTheSame) {
  const BakedScene b = bakeFurnace(GetParam(), Rgb(100.f));
  const test::Deviation d = deviationFrom(b, kPi64 * 100 / 0.5);
  EXPECT_GT(d.texels, 900u);
  EXPECT_LT(d.worst, test::zThreshold(d.texels));
  EXPECT_LT(d.ofMean, 4);
}

/// Mean irradiance of a square of 2 m · s, one texel, by a light of 50 cd at 1 m · s over its middle.
BakedScene lampOverSquare(double s, std::uint64_t photons) {
  SceneBuilder builder;
  builder.addQuad({-s, 0, s}, {s, 0, s}, {s, 0, -s}, {-s, 0, -s}, builder.addDiffuse(Rgb(0.f)));
  Light l;
  l.position = {0, s, 0};
  l.intensity = Rgb(50.f);
  builder.addLight(l);
  return BakedScene(builder.build(), test::quickOptions(photons, 1e-3 / s));
}

TEST_P(Scale, APointLightFallsOffWithTheSquareOfDistance) {
  const double s = GetParam();
  constexpr std::uint64_t kPhotons = 200'000;
  const BakedScene b = lampOverSquare(s, kPhotons);
  ASSERT_EQ(b.baked.maps.irradiance.size(), 1u);
  const double p = test::solidAngleFromMiddle(2, 2, 1) / (4 * kPi64), expected = 4 * kPi64 * 50 * p / (4 * s * s);
  const double z =
      (static_cast<double>(b.baked.maps.irradiance[0].y) / expected - 1) * std::sqrt(p * kPhotons / (1 - p));
  EXPECT_LT(std::abs(z), test::zThreshold(5));
  // A count of n out of N has the relative standard error √(1/n − 1/N), which the one texel's own difference of halves
  // corrects by a per cent or two.
  EXPECT_NEAR(static_cast<double>(b.baked.maps.relativeError[0]) / std::sqrt((1 - p) / (p * kPhotons)), 1, 0.03);
}
INSTANTIATE_TEST_SUITE_P(Metres, Scale, testing::Values(1e-6, 1e-3, 1.0, 1e3, 1e6));

TEST(ScaleByPowersOfTwo, GivesTheSameBits) {
  const BakedScene furnaceOfTwo = bakeFurnace(1, Rgb(100.f), 20'000), lamp = lampOverSquare(1, 20'000);
  for (const int exponent : {-300, -20, 20, 300}) {
    SCOPED_TRACE(exponent);
    expectScaled(bakeFurnace(std::ldexp(1.0, exponent), Rgb(100.f), 20'000), furnaceOfTwo, 1);
  }
  for (const int exponent : {-20, 20}) {
    SCOPED_TRACE(exponent);
    expectScaled(lampOverSquare(std::ldexp(1.0, exponent), 20'000), lamp, std::ldexp(1.0, -2 * exponent));
  }
}

class Flux : public testing::TestWithParam<float> {};

TEST_P(Flux, AFurnaceReadsItsRadiance) {
  const BakedScene b = bakeFurnace(1, Rgb(GetParam()));
  const test::Deviation d = deviationFrom(b, kPi64 * static_cast<double>(GetParam()) / 0.5);
  EXPECT_LT(d.worst, test::zThreshold(d.texels));
  EXPECT_LT(d.ofMean, 4);
}

TEST_P(Flux, DirectionsInHalfPrecisionStillAddUpToTheIrradiance) {
  BakeOptions o = test::quickOptions(100'000, 2);
  o.keepAllDirections = true;
  const BakedScene b(furnace(1, 0.5f, Rgb{1.f, 0.5f, 1e-3f} * GetParam()), o);
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("half" + std::to_string(std::log10(GetParam())) + ".dlm");
  writeDlm(folder, b.scene, b.baked.uv, b.baked.maps, nlohmann::json::object());
  const Dlm dlm = readDlm(folder);
  std::filesystem::remove_all(folder);
  double largest = 0;
  for (const Rgb& v : b.baked.maps.directional) largest = std::max(largest, static_cast<double>(maxComponent(v)));
  const Prober prober(dlm);
  const ProbeAnswer answer = prober.probe({0.7, 0, 0.9}, {0, 1, 0});
  ASSERT_TRUE(answer.onSurface);
  Rgbd sum{};
  for (const ProbeDirection& d : answer.directions) sum += d.irradiance;
  // A half keeps 11 bits, and of numbers far below the largest (which is scaled to 2^14 … 2^15) no less than 2^-25.
  const double lost = 14 * largest * std::ldexp(1.0, -39);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sum[c], answer.irradiance[c], answer.irradiance[c] * std::ldexp(1.0, -11) + lost) << "channel " << c;
}
INSTANTIATE_TEST_SUITE_P(Candela, Flux, testing::Values(1e-12f, 1e-6f, 1.f, 1e6f, 1e12f));

TEST(FluxByPowersOfTwo, GivesTheSameBits) {
  const BakedScene one = bakeFurnace(1, {90.f, 70.f, 50.f}, 20'000);
  for (const float factor : {0x1p-40f, 0x1p40f})
    expectScaled(bakeFurnace(1, Rgb{90.f, 70.f, 50.f} * factor, 20'000), one, static_cast<double>(factor));
}

TEST(Albedo, ZeroEndsEveryPathAtItsFirstHit) {
  const BakedScene b(furnace(1, 0, Rgb(100.f)), test::quickOptions(10'000, 4));
  EXPECT_EQ(b.baked.ledger.rays, 10'000u);
  EXPECT_TRUE(b.baked.ledger.absorbed == b.baked.ledger.emitted);
  EXPECT_TRUE(b.baked.ledger.roulette == FluxSum{});
}

TEST(Albedo, OneInAClosedRoomEndsAtTheDepthBoundAndIsBooked) {
  const BakedScene b(furnace(1, 1, Rgb(100.f)), test::quickOptions(20, 1e-3));
  const Ledger& ledger = b.baked.ledger;
  EXPECT_EQ(ledger.cutOffPaths, 20u);
  EXPECT_EQ(ledger.rays, 20u * TraceLimits{}.depth);
  EXPECT_TRUE(ledger.cutOff == ledger.emitted);
  EXPECT_TRUE(ledger.absorbed == FluxSum{});
  EXPECT_TRUE(ledger.balance() == ledger.emitted);
  double flux = 0;
  forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double a) {
    flux += a * static_cast<double>(b.baked.maps.irradiance[t].y);
  });
  EXPECT_NEAR(flux / (b.baked.emittedFlux * TraceLimits{}.depth), 1, 1e-6);  // floats; the tallies round to 2^-24
}

class Directions : public testing::TestWithParam<int> {};

TEST_P(Directions, AddUpToTheIrradiance) {
  BakeOptions o = test::quickOptions(100'000, 2);
  o.directions = GetParam();
  o.keepAllDirections = true;
  const BakedScene b(furnace(1, 0.5f, {3.f, 2.f, 1.f}), o);
  for (const SideMaps& side : b.baked.maps.sides) {
    ASSERT_TRUE(side.lit);
    EXPECT_LE(side.directions.size(), static_cast<std::size_t>(GetParam()));
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      Rgbd sum{};
      for (const SideDirection& d : side.directions)
        if (d.stored()) sum += Rgbd(b.baked.maps.directional[d.first + t]);
      const Rgbd e(b.baked.maps.irradiance[side.firstTexel + t]);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(sum[c], e[c], 0x1p-23 * e[c]);  // sums in double, rounded to float once each
    }
  }
  const test::Deviation d = deviationFrom(b, kPi64 * 2 * static_cast<double>(luminance(Rgb{3.f, 2.f, 1.f})));
  EXPECT_LT(d.worst, test::zThreshold(d.texels));
}
INSTANTIATE_TEST_SUITE_P(Counts, Directions, testing::Values(1, 2, 3, 4096));

TEST(OneTexelAChart, ReadsTheFurnace) {
  const BakedScene b(furnace(1, 0, Rgb(100.f)), test::quickOptions(300'000, 1e-30));
  EXPECT_EQ(b.baked.maps.irradiance.size(), 6u);
  forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double area) {
    const double p = area * kPi64 * 100 / b.baked.emittedFlux;  // the share of the photons that comes here
    const double z =
        (static_cast<double>(b.baked.maps.irradiance[t].y) / (kPi64 * 100) - 1) * std::sqrt(p * 300'000 / (1 - p));
    EXPECT_LT(std::abs(z), test::zThreshold(6));
  });
}

TEST(OnePhoton, BringsAllTheFluxAndIsNoCertainty) {
  const BakedScene coarse(furnace(1, 0, Rgb(100.f)), test::quickOptions(1, 1e-3));
  double flux = 0;
  forEachTexel(coarse, [&](const SideMaps&, std::uint64_t t, double a) {
    flux += a * static_cast<double>(coarse.baked.maps.irradiance[t].y);
    if (coarse.baked.maps.photons[t] > 0) {
      EXPECT_NEAR(coarse.baked.maps.relativeError[t], 1, 1e-6);
    }
  });
  EXPECT_NEAR(flux / coarse.baked.emittedFlux, 1, 1e-6);
  const BakedScene fine(furnace(1, 0.9f, Rgb(100.f)), test::quickOptions(1, 8));
  int lit = 0;
  for (std::size_t t = 0; t < fine.baked.maps.irradiance.size(); ++t) {
    ASSERT_TRUE(std::isfinite(fine.baked.maps.irradiance[t].y) && std::isfinite(fine.baked.maps.relativeError[t]));
    if (fine.baked.maps.irradiance[t].y <= 0) continue;
    ++lit;
    EXPECT_GT(fine.baked.maps.relativeError[t], 0.1f);
  }
  EXPECT_GT(lit, 0);
}

TEST(FarFromTheOrigin, ASceneGivesTheSameLight) {
  // Coordinates that 1e7 m leaves exact: the same bits.
  const auto room = [](Vec3d at, Vec3d grain) {
    SceneBuilder s;
    s.addBox(at, at + grain, s.addDiffuse(Rgb(0.5f)), true);
    Light l;
    l.position = at + grain * 0.375;
    l.intensity = Rgb(80.f);
    s.addLight(l);
    return BakedScene(s.build(), test::quickOptions(100'000, 8));
  };
  const Vec3d far{1e7, -1e7, 1e7};
  expectScaled(room(far, {2, 1.25, 1.75}), room({}, {2, 1.25, 1.75}), 1);
  // Others differ by what 1e7 m loses, and so do answers to the same questions through a file.
  const BakedScene there = room(far, {2, 1.3, 1.7}), here = room({}, {2, 1.3, 1.7});
  const ProbedBake askThere(there, "far"), askHere(here, "near");
  for (double x = 0.1; x < 2; x += 0.3) {
    for (double z = 0.1; z < 1.7; z += 0.3) {
      const ProbeAnswer a = askThere.at(far + Vec3d{x, 0, z}, {0, 1, 0}), b = askHere.at({x, 0, z}, {0, 1, 0});
      ASSERT_TRUE(a.onSurface && b.onSurface);
      EXPECT_LT(std::abs(a.irradiance.y - b.irradiance.y), test::zThreshold(42) * b.relativeError * b.irradiance.y);
    }
  }
}

/// Tallies and ledger of a range of photons of the furnace.
struct RangeRun {
  RangeRun(const Scene& scene, IndexRange range, int threads)
      : photonScene(scene), plan(makePlan(scene, test::quickOptions(1, 8))), tallies(plan.tallies) {
    const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
    PhotonRunOptions o;
    o.threads = threads;
    traced = runPhotons({photonScene, map, plan.tallies, plan.directions}, range, o, tallies, ledger,
                        [](const RunProgress&) { return true; });
  }
  PhotonScene photonScene;
  BakePlan plan;
  Tallies tallies;
  Ledger ledger;
  std::uint64_t traced;
};

class PhotonIndices : public testing::TestWithParam<std::uint64_t> {};

TEST_P(PhotonIndices, AreTracedOnceEachWhateverTheThreads) {
  const Scene scene = furnace(1, 0.5f, Rgb(100.f));
  const std::uint64_t middle = GetParam(), begin = middle - 20'000, end = std::max(middle, middle + 20'000);
  const RangeRun one(scene, {begin, end}, 1), seven(scene, {begin, end}, 7);
  EXPECT_EQ(one.traced, end - begin);
  EXPECT_EQ(one.ledger.photons, end - begin);
  EXPECT_EQ(one.tallies.contentHash(), seven.tallies.contentHash());
  RangeRun left(scene, {begin, middle - 777}, 1);
  const RangeRun right(scene, {middle - 777, end}, 3);
  left.tallies.add(right.tallies);
  EXPECT_EQ(one.tallies.contentHash(), left.tallies.contentHash());
  EXPECT_NE(one.tallies.contentHash(), RangeRun(scene, {0, end - begin}, 1).tallies.contentHash());
}
// The last: 2^64 − 1, which no range can hold.
INSTANTIATE_TEST_SUITE_P(About, PhotonIndices,
                         testing::Values(std::uint64_t{1} << 32, std::uint64_t{1} << 40, ~std::uint64_t{0}));

TEST(PhotonIndex, AtTheFortiethPowerOfTwoReadTheFurnace) {
  const Scene scene = furnace(1, 0.5f, Rgb(100.f));
  const std::uint64_t first = std::uint64_t{1} << 40;
  const RangeRun run(scene, {first, first + 300'000}, 2);
  BakedScene b(scene, test::quickOptions(1, 8));  // for its plan; the light is the run's
  b.baked.ledger = run.ledger;
  b.baked.maps = resolve(
      {scene, b.plan.charts, b.plan.layout, b.plan.tallies, run.tallies, 14, b.baked.emittedFlux, run.traced}, {});
  const test::Deviation d = deviationFrom(b, kPi64 * 100 / 0.5);
  EXPECT_GT(d.texels, 900u);
  EXPECT_LT(d.worst, test::zThreshold(d.texels));
  EXPECT_LT(d.ofMean, 4);
}

}  // namespace
}  // namespace lucarne::extremes_test
