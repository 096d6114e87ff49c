// Gathered direct light and photons for the rest give the map that photons alone give.
#include "dlm/direct_gather.h"

#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tests/app/truth_scenes.h"

namespace lucarne::direct_gather_test {
namespace {

using test::BakedScene;

BakeOptions roomOptions(DirectMode mode, std::uint64_t photons) {
  BakeOptions o = test::quickOptions(photons, 3);
  o.keepAllDirections = true;
  o.seed = 11;
  o.direct = mode;
  o.directSamples = 32;
  return o;
}

struct Difference {
  double largestZ = 0, ratio = 0;  // of the sums of both maps
  std::uint64_t texels = 0;
};

/// Texel by texel, in standard errors of both. Texels of few photons are left out: their error is not known.
Difference compare(const BakedScene& a, const BakedScene& b) {
  Difference d;
  double sumA = 0, sumB = 0;
  for (std::size_t s = 0; s < a.baked.maps.sides.size(); ++s) {
    const SideMaps &sideA = a.baked.maps.sides[s], &sideB = b.baked.maps.sides[s];
    if (!sideA.lit || !sideB.lit) continue;
    for (std::uint64_t t = 0; t < sideA.texelCount(); t += 5) {
      const std::uint64_t i = sideA.firstTexel + t, j = sideB.firstTexel + t;
      constexpr float kFewest = 100;
      if (a.baked.maps.photons[i] < kFewest || b.baked.maps.photons[j] < kFewest) continue;
      const double x = static_cast<double>(luminance(a.baked.maps.irradiance[i])),
                   y = static_cast<double>(luminance(b.baked.maps.irradiance[j]));
      const double error = std::hypot(x * static_cast<double>(a.baked.maps.relativeError[i]),
                                      y * static_cast<double>(b.baked.maps.relativeError[j]));
      d.largestZ = std::max(d.largestZ, std::abs(x - y) / error);
      ++d.texels;
      sumA += x;
      sumB += y;
    }
  }
  d.ratio = sumA / sumB;
  return d;
}

class GatheredRooms : public ::testing::TestWithParam<const char*> {};

TEST_P(GatheredRooms, AgreeWithPhotonsWithinTheirStandardErrors) {
  for (const test::TruthScene& scene : test::truthScenes()) {
    if (scene.name != GetParam()) continue;
    const auto sky = scene.sky();
    const BakedScene photons(scene.make(), roomOptions(DirectMode::photons, 1'000'000), sky.get());
    const BakedScene gathered(scene.make(), roomOptions(DirectMode::gathered, 1'000'000), sky.get());
    const Difference d = compare(gathered, photons);
    ASSERT_GT(d.texels, 100u);
    EXPECT_LT(d.largestZ, test::zThreshold(d.texels));
    EXPECT_NEAR(d.ratio, 1, 0.01);
    EXPECT_EQ(gathered.baked.direct.counts.strayValues, 0u);
    EXPECT_GT(gathered.baked.direct.counts.places, 32 * d.texels);
  }
}
INSTANTIATE_TEST_SUITE_P(, GatheredRooms,
                         ::testing::Values("diffuse", "smooth sphere", "clear glass", "alpha mask", "alpha blend",
                                           "painted lamp", "bulb and spot", "sky through a window"),
                         [](const auto& room) {
                           std::string name = room.param;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

TEST(GatheredRoomWithAWeakerLamp, DoesNotAgree) {
  Scene weaker = test::truthScenes()[0].make();
  weaker.materials[1].emissive *= 0.9f;
  const BakedScene photons(test::truthScenes()[0].make(), roomOptions(DirectMode::photons, 1'000'000));
  const BakedScene gathered(weaker, roomOptions(DirectMode::gathered, 1'000'000));
  EXPECT_GT(compare(gathered, photons).largestZ, test::zThreshold(1000));
}

BakeOptions directAlone(double density) {
  BakeOptions o = test::quickOptions(1, density);
  o.light = LightPart::direct;
  o.direct = DirectMode::gathered;
  o.directSamples = 16;
  o.kernel.width = 0.5;  // each texel by itself
  return o;
}

/// A floor of 2 × 2 m and a lamp over it: E = I·cosθ/d².
Scene floorUnderBulb(double height) {
  test::SceneBuilder s;
  s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, s.addDiffuse(Rgb(0.5f)));
  Light bulb;
  bulb.position = {0, height, 0};
  bulb.intensity = {100, 50, 25};
  s.addLight(bulb);
  return s.build();
}

TEST(GatheredAlone, UnderABulbIsTheInverseSquare) {
  const BakedScene b(floorUnderBulb(0.8), directAlone(8));
  EXPECT_EQ(b.baked.ledger.photons, 0u) << "no photon is needed";
  const SideMaps& side = b.baked.maps.sides.at(0);
  ASSERT_EQ(side.texelCount(), 256u);
  // Of a function that is smooth over a texel, two sets of four stratified places give a mean far better than its spread
  // of some percent; what is left is a bound on both.
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      double expected = 0;  // mean over the texel
      for (int i = 0; i < 64; ++i) {
        const double u = (x + (i % 8 + 0.5) / 8) / 8 - 1, v = (y + (i / 8 + 0.5) / 8) / 8 - 1;
        expected += 100 * 0.8 / std::pow(u * u + v * v + 0.64, 1.5) / 64;
      }
      const Rgb e = b.baked.maps.irradiance[side.firstTexel + static_cast<std::uint64_t>(16 * y + x)];
      EXPECT_NEAR(static_cast<double>(e.x) / expected, 1, 0.02) << x << " " << y;
      EXPECT_NEAR(static_cast<double>(e.y / e.x), 0.5, 1e-4);
    }
}

/// A lamp that is seen at a slant must not lie in its own shadow, by however little the ray starts off the wall.
TEST(GatheredAlone, OfAStripBeforeAWallIsItsIntegral) {
  test::SceneBuilder s;
  s.addBox({-3, 0, -2.25}, {3, 2.7, 2.25}, s.addDiffuse(Rgb(0.5f)), true);
  s.addQuad({1.15, 2.4, -1.855}, {-1.15, 2.4, -1.855}, {-1.15, 2.5, -1.855}, {1.15, 2.5, -1.855},
            s.addDiffuse(Rgb(0.f), Rgb(4200.f)));  // faces the wall
  const Scene scene = s.build();
  const PhotonScene photonScene(scene);
  const PathTracer paths(photonScene);
  constexpr std::uint64_t kPlaces = 3, kSamples = 4096;
  for (std::uint64_t i = 0; i < kPlaces; ++i) {
    const Vec3d at{0.11 + 0.2 * static_cast<double>(i), 1.93 - 0.31 * static_cast<double>(i), -2.25};
    double expected = 0;
    constexpr int kX = 460, kY = 20;
    for (int k = 0; k < kX * kY; ++k) {
      const Vec3d to = Vec3d{-1.15 + 2.3 * (k % kX + 0.5) / kX, 2.4 + 0.1 * (k / kX + 0.5) / kY, -1.855} - at;
      expected += 4200 * to.z * to.z / (dot(to, to) * dot(to, to)) * 2.3 * 0.1 / (kX * kY);
    }
    const Vec3f eye(scene.frame.toLocal(at + Vec3d{0, 0, 0.1})), ahead{0, 0, -1};
    std::uint64_t repeats = 0;
    const auto wall = photonScene.rayCaster().nearest(eye, ahead, kNone, repeats);
    const Hit hit = photonScene.rayCaster().intersect(wall, eye, ahead);
    const Receiver receiver = receiverAt(photonScene, wall, hit.b, false);
    double sum = 0, squares = 0;
    for (std::uint64_t k = 0; k < kSamples; ++k) {
      const ReceivedLight light = paths.receiveDirect(receiver, {{7, SamplerKind::random}, kSamples * i + k});
      double e = 0;
      for (std::size_t p = 0; p < light.count; ++p) e += static_cast<double>(light.pieces[p].lux.y);
      sum += e;
      squares += e * e;
    }
    const double mean = sum / kSamples, error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
    EXPECT_LT(std::abs(mean - expected), 5 * error + 0.002 * expected) << i;
    EXPECT_LT(error, 0.03 * expected);
  }
}

TEST(GatheredAlone, HasAnErrorThatItKnows) {
  BakeOptions o = directAlone(2);
  o.directSamples = 64;
  o.sampler = SamplerKind::random;
  o.seed = 3;
  const Scene scene = test::truthScenes()[0].make();
  const BakedScene a(scene, o);
  o.seed = 4;
  const BakedScene b(scene, o);
  double squares = 0, texels = 0;
  for (std::size_t t = 0; t < a.baked.maps.irradiance.size(); ++t) {
    const double x = static_cast<double>(luminance(a.baked.maps.irradiance[t])),
                 y = static_cast<double>(luminance(b.baked.maps.irradiance[t]));
    const double error = std::hypot(x * static_cast<double>(a.baked.maps.relativeError[t]),
                                    y * static_cast<double>(b.baked.maps.relativeError[t]));
    if (!(error > 0)) continue;
    squares += std::min(9.0, (x - y) * (x - y) / (error * error));
    ++texels;
  }
  ASSERT_GT(texels, 200);
  EXPECT_NEAR(squares / texels, 1, 5 * std::sqrt(2 / texels));  // χ² of as many
}

TEST(GatheredAlone, CutsWhatIsTooBrightAndSaysSo) {
  const BakedScene near(floorUnderBulb(0.0005), directAlone(1000.0 / 16)), far(floorUnderBulb(0.8), directAlone(8));
  EXPECT_GT(near.baked.direct.counts.clamped, 0u);
  EXPECT_EQ(far.baked.direct.counts.clamped, 0u);
  for (const Rgb& e : near.baked.maps.irradiance) EXPECT_TRUE(isFinite(e));
}

TEST(Gathered, IndirectLightAsksForNone) {
  BakeOptions o = roomOptions(DirectMode::gathered, 20'000);
  o.light = LightPart::indirect;
  EXPECT_FALSE(gathersDirect(o));
  BakeOptions plain = o;
  plain.direct = DirectMode::photons;
  const Scene scene = test::truthScenes()[0].make();
  EXPECT_EQ(BakedScene(scene, o).baked.contentHash, BakedScene(scene, plain).baked.contentHash);
}

}  // namespace
}  // namespace lucarne::direct_gather_test
