// Map and gather have the same expectation: photons that end at a texel, and paths that start there.
#include "dlm/texel_gather.h"

#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tests/app/truth_scenes.h"
#include "tests/support/statistics.h"

namespace lucarne::gather_test {
namespace {

struct Comparison {
  double z, map, gather;
};

BakeOptions quickOptions(std::uint64_t photons) {
  BakeOptions o;
  o.kernel = {};
  o.photons = photons;
  o.texelsPerMetre = 2;
  o.keepAllDirections = true;
  o.directions = 14;
  o.seed = 5;
  o.seams = SeamMode::keep;  // the gather knows nothing of other charts
  return o;
}

/// At texels all over the scene: the map's and the gather's luminance, in standard errors of both.
std::vector<Comparison> compare(const test::BakedScene& baked, const BakeOptions& options, std::uint64_t paths,
                                const PhotonScene& gathered) {
  std::vector<Comparison> all;
  const GatherScene in{gathered, baked.plan.charts, baked.plan.layout, baked.plan.tallies, baked.plan.directions,
                       *baked.baked.contacts};
  const LightMaps& maps = baked.baked.maps;
  std::uint32_t lit = 0;
  for (std::uint32_t s = 0; s < maps.sides.size(); ++s) {
    const SideMaps& side = maps.sides[s];
    if (!side.lit) continue;
    const int stride = std::max<int>(2, static_cast<int>(side.texelCount() / 8));
    for (int t = static_cast<int>(lit++ % 3); t < static_cast<int>(side.texelCount()); t += stride) {
      const auto texel = side.firstTexel + static_cast<std::uint64_t>(t);
      constexpr float kFewest = 100;  // photons: the error of fewer is not known
      if (maps.photons[texel] < kFewest) continue;
      const TexelGatherResult truth =
          gatherTexel(in, s, t % side.width, t / side.width, options.kernel, options.light, paths, 17);
      if (!truth.covered) continue;
      const double map = static_cast<double>(luminance(maps.irradiance[texel]));
      const double error =
          std::hypot(map * static_cast<double>(maps.relativeError[texel]), truth.luminance.standardError);
      all.push_back({(map - truth.luminance.mean) / error, map, truth.luminance.mean});
    }
  }
  return all;
}

double largestZ(const std::vector<Comparison>& all) {
  double z = 0;
  for (const Comparison& c : all) z = std::max(z, std::abs(c.z));
  return z;
}

class MapAndGather : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MapAndGather, AgreeWithinTheirStandardErrors) {
  const test::TruthScene scene = test::truthScenes()[GetParam()];
  const auto sky = scene.sky();
  const BakeOptions options = quickOptions(400'000);
  const test::BakedScene baked(scene.make(), options, sky.get());
  const std::vector<Comparison> all = compare(baked, options, 1500, baked.photonScene);
  ASSERT_GT(all.size(), 20u) << scene.name;
  double map = 0, gather = 0;
  for (const Comparison& c : all) {
    map += c.map;
    gather += c.gather;
    if (std::getenv("LUCARNE_SHOW")) std::printf("z %.2f map %.3f gather %.3f\n", c.z, c.map, c.gather);
  }
  EXPECT_LT(largestZ(all), test::zThreshold(all.size()))
      << scene.name << ": mean " << map / gather << " of " << all.size();
  EXPECT_NEAR(map / gather, 1, 0.02) << scene.name;
}

INSTANTIATE_TEST_SUITE_P(, MapAndGather, ::testing::Range<std::size_t>(0, test::truthScenes().size()),
                         [](const auto& scene) {
                           std::string name = test::truthScenes()[scene.param].name;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

TEST(MapAndGatherOfDifferentRooms, DoNotAgree) {
  const BakeOptions options = quickOptions(400'000);
  const test::BakedScene baked(test::truthScenes()[0].make(), options);
  Scene darker = test::truthScenes()[0].make();
  darker.materials[0].baseColor *= 0.95f;
  const PhotonScene other(darker);
  EXPECT_GT(largestZ(compare(baked, options, 1500, other)), test::zThreshold(100));
}

}  // namespace
}  // namespace lucarne::gather_test
