// The standard error that each texel is said to have, against the spread of many bakes with other seeds.
#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tests/app/truth_scenes.h"

namespace lucarne::known_error_test {
namespace {

using test::BakedScene;

constexpr std::uint64_t kSeeds = 32;

/// One texel over the seeds.
struct Texel {
  double sum = 0, squares = 0, said = 0, photons = 0, area = 0;
  double mean() const { return sum / kSeeds; }
  double variance() const { return (squares - sum * sum / kSeeds) / (kSeeds - 1); }
  double saidVariance() const { return said / kSeeds; }
};

std::vector<Texel> bakeManyTimes(const Scene& scene, BakeOptions options, const Environment* sky) {
  std::vector<Texel> texels;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    options.seed = seed;
    const BakedScene b(scene, options, sky);
    // Every side is lit in every bake: the same texels.
    texels.resize(b.baked.maps.irradiance.size());
    test::forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double area) {
      const double e = static_cast<double>(luminance(b.baked.maps.irradiance[t]));
      const double error = static_cast<double>(b.baked.maps.standardError[t]);
      Texel& texel = texels[t];
      texel.sum += e;
      texel.squares += e * e;
      texel.said += error * error;
      texel.photons += static_cast<double>(b.baked.maps.photons[t]) / kSeeds;
      texel.area = area;
    });
  }
  return texels;
}

/// True over said error of all texels with between `fewest` and `most` photons, on average. `relative`: each texel by
/// its own brightness, else by its area.
struct Ratio {
  double value = 0;
  std::size_t texels = 0;
};

Ratio ratioOf(const std::vector<Texel>& texels, double fewest, double most, bool relative) {
  double isVariance = 0, saidVariance = 0;
  Ratio ratio;
  for (const Texel& t : texels) {
    if (!(t.area > 0) || t.photons < fewest || t.photons >= most || !(t.mean() > 0)) continue;
    const double weight = relative ? 1 / (t.mean() * t.mean()) : t.area;
    isVariance += weight * t.variance();
    saidVariance += weight * t.saidVariance();
    ++ratio.texels;
  }
  ratio.value = std::sqrt(isVariance / saidVariance);
  return ratio;
}

struct KnownErrorCase {
  std::string name;
  std::function<Scene()> make;
  std::uint64_t photons;
  double texelsPerMetre;
  SamplerKind sampler = SamplerKind::sobol;
  bool sky = false;
  std::uint64_t directSamples = 0;
  KernelShape kernel = KernelShape::pyramid;
};

void PrintTo(const KnownErrorCase& c, std::ostream* out) { *out << c.name; }

class KnownError : public ::testing::TestWithParam<KnownErrorCase> {};

TEST_P(KnownError, IsTheSpreadOfManyBakes) {
  const KnownErrorCase& c = GetParam();
  BakeOptions options = test::quickOptions(c.photons, c.texelsPerMetre);
  options.sampler = c.sampler;
  options.kernel.shape = c.kernel;
  if (c.directSamples > 0) {
    options.direct = DirectMode::gathered;
    options.directSamples = c.directSamples;
  }
  const std::unique_ptr<Environment> sky = c.sky ? test::sunnySky(200) : nullptr;
  const std::vector<Texel> texels = bakeManyTimes(c.make(), options, sky.get());
  std::size_t judged = 0;
  for (const auto& [fewest, most] : {std::pair{0.0, 1.0}, {1.0, 4.0}, {4.0, 16.0}, {16.0, 64.0}, {64.0, 1e9}})
    for (const bool relative : {false, true}) {
      const Ratio ratio = ratioOf(texels, fewest, most, relative);
      if (ratio.texels < 200) continue;  // too few to tell 0.9 from 1
      judged += ratio.texels;
      // Slivers that catch next to nothing lean on neighbours, whose light a wide kernel takes from a larger surface.
      if (c.kernel != KernelShape::adaptive || fewest > 0) {
        EXPECT_GT(ratio.value, 0.9) << fewest << " to " << most << " photons, relative " << relative;
      }
      EXPECT_LT(ratio.value, 1.1) << fewest << " to " << most << " photons, relative " << relative;
      std::printf("%s: %g to %g photons, %s: %.3f (%zu texels)\n", c.name.c_str(), fewest, most,
                  relative ? "relative" : "absolute", ratio.value, ratio.texels);
    }
  EXPECT_GT(judged, texels.size() / 2);
}

Scene diffuseRoom() {
  test::SceneBuilder b = test::lampRoom(test::diffuseMaterial({0.7f, 0.6f, 0.5f}));
  test::addBlock(b, test::diffuseMaterial({0.2f, 0.4f, 0.8f}));
  return b.build();
}

Scene glassRoom() {
  test::SceneBuilder b = test::lampRoom(test::diffuseMaterial({0.7f, 0.6f, 0.5f}));
  test::addBlock(b, test::glassMaterial(true, 0.05f));
  return b.build();
}

INSTANTIATE_TEST_SUITE_P(
    Rooms, KnownError,
    ::testing::Values(KnownErrorCase{"few photons", diffuseRoom, 2'000, 4},
                      KnownErrorCase{"some photons", diffuseRoom, 10'000, 4},
                      KnownErrorCase{"many photons", diffuseRoom, 100'000, 4},
                      KnownErrorCase{"planes", diffuseRoom, 10'000, 4, SamplerKind::sobol, false, 0, KernelShape::linear},
                      KnownErrorCase{"adaptive", diffuseRoom, 10'000, 4, SamplerKind::sobol, false, 0, KernelShape::adaptive},
                      KnownErrorCase{"adaptive many", diffuseRoom, 100'000, 4, SamplerKind::sobol, false, 0, KernelShape::adaptive},
                      KnownErrorCase{"adaptive fine", diffuseRoom, 30'000, 12, SamplerKind::sobol, false, 0, KernelShape::adaptive},
                      KnownErrorCase{"adaptive caustics", glassRoom, 30'000, 4, SamplerKind::sobol, false, 0, KernelShape::adaptive},
                      KnownErrorCase{"adaptive lights", test::threeLights, 50'000, 4, SamplerKind::sobol, false, 0, KernelShape::adaptive},
                      KnownErrorCase{"random numbers", diffuseRoom, 20'000, 4, SamplerKind::random},
                      KnownErrorCase{"caustics", glassRoom, 30'000, 4},
                      KnownErrorCase{"small bright lights", test::threeLights, 50'000, 4},
                      KnownErrorCase{"sky through a window", test::windowRoom, 50'000, 4, SamplerKind::sobol, true},
                      KnownErrorCase{"gathered", diffuseRoom, 20'000, 3, SamplerKind::sobol, false, 9}),
    [](const auto& one) {
      std::string name = one.param.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    });

}  // namespace
}  // namespace lucarne::known_error_test
