// Each kind of light alone in a room: it gives the flux of its closed form, and the ledger accounts for all of it.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "base/math.h"
#include "tests/support/textures.h"
#include "tests/tracer/environment_maps.h"
#include "tests/tracer/photon_runs.h"

namespace lucarne::ledger_per_light_test {
namespace {

using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;
constexpr std::uint64_t kPhotons = 60'000;

struct LightCase {
  std::string name;
  Scene scene;
  Rgbd flux;  // lm
  bool closed = true;
  std::shared_ptr<const Environment> sky = nullptr;
};

/// 4 × 3 × 5 m, grey, a box in it.
SceneBuilder greyRoom() {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 5}, b.addDiffuse({0.6f, 0.7f, 0.5f}), true);
  b.addBox({0.5, 0.2, 0.5}, {1, 1, 1.5}, b.addDiffuse({0.3f, 0.2f, 0.8f}), false);
  return b;
}

constexpr double kRoomRadius2 = 0.25 * (16 + 9 + 25);  // of its bounding sphere, squared

const Rgb kRadiance{90, 70, 50};

/// A lamp of 2 × 1 m that hangs in the room, facing down.
LightCase lampCase(const std::string& name, bool doubleSided, bool textured) {
  SceneBuilder b = greyRoom();
  Material m = test::diffuseMaterial(Rgb(0.2f), kRadiance);
  m.doubleSided = doubleSided;
  const auto lamp = b.addMaterial(m);
  b.addQuad({1, 2, 1.5}, {3, 2, 1.5}, {3, 2, 2.5}, {1, 2, 2.5}, lamp);
  Scene s = b.build();
  Rgbd average(1);
  if (textured) {
    average = {};
    const auto texel = [](int x, int y) {
      return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(x == y ? 255 : 10),
                                         static_cast<std::uint8_t>(30 * y), static_cast<std::uint8_t>(x == 3 ? 200 : 0),
                                         255};
    };
    s.materials[lamp].emissiveTexture = test::addTexture(s, 8, texel, true);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x)
        for (int c = 0; c < 3; ++c)
          average[c] += static_cast<double>(srgbToLinear(texel(x, y)[static_cast<std::size_t>(c)])) / 64;
  }
  return {name, std::move(s), Rgbd(kRadiance) * average * (kPi64 * 2 * (doubleSided ? 2 : 1))};
}

LightCase lightCase(const std::string& name, const Light& light, double fluxPerIntensity, bool closed) {
  SceneBuilder b = greyRoom();
  b.addLight(light);
  return {name, b.build(), Rgbd(light.intensity) * fluxPerIntensity, closed};
}

std::vector<LightCase> lightCases() {
  std::vector<LightCase> cases;
  cases.push_back(lampCase("lamp", false, false));
  cases.push_back(lampCase("double-sided lamp", true, false));
  cases.push_back(lampCase("painted lamp", false, true));
  cases.push_back(lampCase("double-sided painted lamp", true, true));
  cases.push_back(lightCase("bulb", test::bulbLight({2, 2, 2}, {40, 30, 20}), 4 * kPi64, true));
  Light spot = test::bulbLight({2, 2, 2}, {40, 30, 20});
  spot.kind = LightKind::spot;
  spot.direction = normalize(Vec3d{0.5, -1, -0.6});
  spot.cosInner = 0.95;
  spot.cosOuter = 0.8;
  cases.push_back(lightCase("spot", spot, 2 * kPi64 * (0.05 + 0.15 / 3), true));
  // Light from far away starts outside and falls on the backs of the walls.
  const double disc = kPi64 * kRoomRadius2;
  cases.push_back(lightCase("sun", test::sunLight({0.3, -1, 0.2}, {500, 400, 300}), disc, false));
  LightCase sky{"sky", greyRoom().build(), {}, false};
  sky.sky = std::make_shared<Environment>(test::sunMap(32, 16, 100), "sky");
  sky.flux = sky.sky->scalarIrradiance() * disc;
  cases.push_back(std::move(sky));
  return cases;
}

TEST(LedgerOfOneLight, EmittedFluxIsTheClosedForm) {
  for (const LightCase& c : lightCases()) {
    const PhotonScene photons(c.scene, {}, c.sky.get());
    const Ledger l = test::fly(photons, kPhotons, PhotonSeed(6, SamplerKind::random));
    EXPECT_EQ(l.photons, kPhotons);
    std::array<test::Mean, 3> beta;
    for (std::uint64_t i = 0; i < kPhotons; ++i) {
      const Rgb b = photons.emitters().sample(PhotonSampler(6, i).emission()).beta;
      for (int k = 0; k < 3; ++k) beta[static_cast<std::size_t>(k)].add(static_cast<double>(b[k]));
    }
    for (int k = 0; k < 3; ++k) {
      const auto channel = static_cast<std::size_t>(k);
      const double emitted = static_cast<double>(l.emitted.units[channel]) * 0x1p-24 / kPhotons;
      const double flux = emitted * photons.emitters().totalFlux();
      const double error = beta[channel].error() * photons.emitters().totalFlux();
      EXPECT_NEAR(emitted, beta[channel].mean(), 1e-6 * emitted) << c.name << ": the ledger's and the emitters' sum";
      // The disc of light from far away is 1e-4 wider than the scene.
      EXPECT_NEAR(flux, c.flux[k], test::zThreshold(24) * error + 3e-4 * c.flux[k]) << c.name << " channel " << k;
    }
  }
}

TEST(LedgerOfOneLight, EveryUnitOfItIsAccountedFor) {
  for (const LightCase& c : lightCases()) {
    for (const SamplerKind kind : {SamplerKind::random, SamplerKind::sobol}) {
      const PhotonScene photons(c.scene, {}, c.sky.get());
      const Ledger l = test::fly(photons, 20'000, PhotonSeed(6, kind));
      test::expectBalance(l);
      EXPECT_TRUE(l.cutOff == FluxSum{}) << c.name;
      EXPECT_TRUE(l.shadingNormal == FluxSum{}) << c.name;
      EXPECT_TRUE(l.expectedAbsorbed == l.absorbed) << c.name << ": diffuse surfaces take what they are expected to";
      EXPECT_EQ(l.escaped == FluxSum{}, c.closed) << c.name;
      FluxSum rest = l.absorbed;
      rest += l.escaped;
      rest += l.roulette;
      EXPECT_TRUE(rest == l.emitted) << c.name;
      EXPECT_GT(test::share(l.absorbed, l), 0.5 - 0.5 * !c.closed) << c.name;
    }
  }
}

// Nothing of the sun or the sky comes into a closed room: its walls' backs take it all.
TEST(LedgerOfOneLight, LightFromFarAwayEndsAtTheBacksOfAClosedRoom) {
  for (const LightCase& c : lightCases()) {
    if (c.closed) continue;
    const PhotonScene photons(c.scene, {}, c.sky.get());
    const Ledger l = test::fly(photons, 20'000);
    EXPECT_EQ(l.rays, l.photons) << c.name;
    FluxSum ended = l.absorbed;
    ended += l.escaped;
    EXPECT_TRUE(ended == l.emitted) << c.name;
  }
}

}  // namespace
}  // namespace lucarne::ledger_per_light_test
