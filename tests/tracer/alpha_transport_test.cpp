// Light through holes: masks, blends and the backs of painted skies.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/textures.h"
#include "tests/tracer/photon_runs.h"
#include "tracer/transport/path_tracer.h"

namespace lucarne::alpha_transport_test {
namespace {

using test::FluxMeter;
using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;

Material screenMaterial(AlphaMode mode, float alpha = 1) {
  Material m = test::diffuseMaterial(Rgb(0.f));
  m.doubleSided = true;
  m.alphaMode = mode;
  m.alpha = alpha;
  return m;
}

/// Texels of the mask below that are there: 3 of 8 in each row.
bool isThere(int x, int y) { return (x + 2 * y) % 8 < 3; }
std::array<std::uint8_t, 4> maskTexel(int x, int y) {
  return {255, 255, 255, static_cast<std::uint8_t>(isThere(x, y) ? 255 : 0)};
}

/// A mask of 2 × 2 m, 1 m over a floor, under a sun in the zenith.
struct MaskScene {
  MaskScene() {
    SceneBuilder b;
    test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
    const auto screen = b.addMaterial(screenMaterial(AlphaMode::mask));
    test::addPlate(b, 1, 1, screen);
    b.addLight(test::sunLight({0, -1, 0}, Rgb(500.f)));
    scene = b.build();
    scene.materials[screen].baseColorTexture = test::addTexture(scene, 8, maskTexel, true);
  }
  /// Whether the mask is there above or below a hit. u = (x + 1)/2, v = (1 − z)/2.
  bool covered(const PhotonHit& h) const {
    const Vec3d p = scene.frame.toWorld(h.hit.position);
    const auto texel = [](double u) { return std::clamp(static_cast<int>(u * 8), 0, 7); };
    return isThere(texel(0.5 * (p.x + 1)), texel(0.5 * (1 - p.z)));
  }
  Scene scene;
};

TEST(AlphaTransport, AMaskLetsThroughExactlyWhatItDoesNotCover) {
  const MaskScene mask;
  const PhotonScene photons(mask.scene);
  std::size_t wrong = 0;
  const auto place = [&](const PhotonHit& h) -> std::size_t {
    const bool onScreen = h.hit.material == 1;
    wrong += mask.covered(h) != onScreen;
    return onScreen ? 1 : 0;
  };
  FluxMeter meter(2, place);
  const Ledger l = test::fly(photons, 200'000, meter);
  test::expectBalance(l);
  // Hits within a rounding of a texel's border may count with either.
  EXPECT_LE(wrong, 5u);
  const double onSquare = 4 * 500 / photons.emitters().totalFlux();
  test::expectMean(meter[0], onSquare * 5 / 8, 2);
  test::expectMean(meter[1], onSquare * 3 / 8, 2);
}

TEST(AlphaTransport, ABlendIsMetAsOftenAsItsAlphaSays) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
  test::addPlate(b, 1, 1, b.addMaterial(screenMaterial(AlphaMode::blend, 0.3f)));
  b.addLight(test::sunLight({0, -1, 0}, Rgb(500.f)));
  const Scene scene = b.build();
  const PhotonScene photons(scene);
  FluxMeter meter(2, [](const PhotonHit& h) { return h.hit.material; });
  test::expectBalance(test::fly(photons, 200'000, meter));
  const double onSquare = 4 * 500 / photons.emitters().totalFlux();
  test::expectMean(meter[1], 0.3 * onSquare, 2);
  test::expectMean(meter[0], 0.7 * onSquare, 2);
}

TEST(AlphaTransport, FiftyLayersThinLightLikeAGeometricSeries) {
  constexpr int kLayers = 50;
  for (const SamplerKind kind : {SamplerKind::random, SamplerKind::sobol}) {
    SceneBuilder b;
    test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
    const auto veil = b.addMaterial(screenMaterial(AlphaMode::blend, 0.1f));
    for (int i = 0; i < kLayers; ++i) test::addPlate(b, 2 - 0.02 * i, 1, veil);
    b.addLight(test::sunLight({0, -1, 0}, Rgb(500.f)));
    const Scene scene = b.build();
    const PhotonScene photons(scene);
    std::vector<double> met(kLayers + 1), expected(kLayers + 1);
    struct Counter {
      std::vector<double>& met;
      void hit(const PhotonHit& h) { ++met[h.hit.triangle < 2 ? kLayers : (h.hit.triangle - 2) / 2]; }
      void endPhoton() {}
    } counter{met};
    test::expectBalance(test::fly(photons, 200'000, counter, PhotonSeed(3, kind)));
    double all = 0;
    for (const double n : met) all += n;
    for (int i = 0; i <= kLayers; ++i)
      expected[static_cast<std::size_t>(i)] = all * std::pow(0.9, i) * (i < kLayers ? 0.1 : 1);
    EXPECT_GT(test::chiSquareP(met, expected), 1e-4);
    const double through = all * std::pow(0.9, kLayers);
    EXPECT_NEAR(met[kLayers], through, test::zThreshold(2) * std::sqrt(through));
  }
}

/// A closed room with a decal of 3 × 3 m in the very plane of its floor.
Scene roomWithADecal(AlphaMode mode, float alpha, bool textured, bool doubleSided) {
  SceneBuilder b;
  b.addBox({-2, 0, -2}, {2, 3, 2}, b.addDiffuse(Rgb(0.7f)), true);
  Material m = screenMaterial(mode, alpha);
  m.baseColor = Rgb(0.5f);
  m.doubleSided = doubleSided;
  const auto decal = b.addMaterial(m);
  test::addPlate(b, 0, 1.5, decal);
  b.addLight(test::bulbLight({0.3, 2, 0.2}, Rgb(100.f)));
  Scene scene = b.build();
  if (textured) scene.materials[decal].baseColorTexture = test::addTexture(scene, 8, maskTexel, true);
  return scene;
}

TEST(AlphaTransport, DecalsInTheVeryPlaneOfAFloorLoseNoLight) {
  for (const bool doubleSided : {false, true}) {
    for (const Scene& scene : {roomWithADecal(AlphaMode::mask, 1, true, doubleSided),
                               roomWithADecal(AlphaMode::blend, 0.4f, false, doubleSided)}) {
      std::uint64_t met = 0;
      const auto count = [&](const PhotonHit& h) { return ++met, h.hit.material; };
      FluxMeter meter(2, count);
      const Ledger l = test::fly(PhotonScene(scene), 50'000, meter);
      test::expectBalance(l);
      test::expectNothingEscapes(l);
      EXPECT_EQ(l.hits, met) << "light ended at a back";
      EXPECT_GT(meter[1].sum, 0) << "the decal is there";
    }
  }
}

/// What each photon of a sun meets first of a floor (material 0), a veil over it (1) and more veils over that (2).
std::vector<std::uint32_t> metFirst(int moreVeils) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
  test::addPlate(b, 0.5, 1, b.addMaterial(screenMaterial(AlphaMode::blend, 0.3f)));
  const auto more = b.addMaterial(screenMaterial(AlphaMode::blend, 0.1f));
  b.addTriangle({1, 1, 1}, {1, 1, 0.99}, {0.99, 1, 1}, 0);  // the scene's box is the same for all
  for (int i = 0; i < moreVeils; ++i) test::addPlate(b, 0.9 - 0.05 * i, 1, more);
  b.addLight(test::sunLight({0, -1, 0}, Rgb(500.f)));
  const Scene scene = b.build();
  struct Recorder {
    std::vector<std::uint32_t> met{kNone};
    void hit(const PhotonHit& h) { met.back() = h.hit.material; }
    void endPhoton() { met.push_back(kNone); }
  } recorder;
  test::fly(PhotonScene(scene), 20'000, recorder);
  return recorder.met;
}

// The number of a blend is one of the surface, not of how many a photon went through before.
TEST(AlphaTransport, WhatAVeilDoesToAPhotonDoesNotDependOnOtherVeils) {
  const std::vector<std::uint32_t> alone = metFirst(0), amongOthers = metFirst(5);
  std::size_t different = 0, caught = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    caught += amongOthers[i] == 1;
    different += amongOthers[i] != 2 && amongOthers[i] != alone[i];
  }
  EXPECT_GT(caught, 500u);
  EXPECT_EQ(different, 0u);
}

/// A painted sky: an unlit box whose fronts look inward, with a grey floor in it.
Scene paintedSky(bool doubleSided) {
  SceneBuilder b;
  Material sky = test::diffuseMaterial(Rgb(0.9f), Rgb(1000.f));
  sky.unlit = true;
  sky.doubleSided = doubleSided;
  const auto floor = b.addDiffuse(Rgb(0.5f));
  test::addPlate(b, 0.1, 0.8, floor);
  b.addBox({-1, 0, -1}, {1, 2, 1}, b.addMaterial(sky), true);
  b.addLight(test::sunLight({0.1, -1, 0.05}, Rgb(700.f)));
  return b.build();
}

TEST(AlphaTransport, APaintedSkyLetsTheSunInAndIsBlackFromWithin) {
  const Scene scene = paintedSky(false);
  const PhotonScene photons(scene);
  std::size_t later = 0;
  const auto place = [&](const PhotonHit& h) {
    later += h.hit.material == 0 && h.event > 1;
    return h.hit.material;
  };
  FluxMeter meter(2, place);
  const Ledger l = test::fly(photons, 200'000, meter);
  test::expectBalance(l);
  const double cosine = 1 / std::sqrt(1 + 0.01 + 0.0025), flux = photons.emitters().totalFlux();
  test::expectMean(meter[0], 1.6 * 1.6 * 700 * cosine / flux, 2);
  EXPECT_EQ(later, 0u) << "nothing comes back from the sky";
  // All else that enters meets the bottom of the box; what misses the box goes on.
  const double enters = (4 * cosine + 4 * (0.1 + 0.05) * cosine) * 700 / flux;
  EXPECT_NEAR(test::share(l.escaped, l), 1 - enters, 0.01);
  const PathTracer paths(photons);
  EXPECT_EQ(paths.radiance({Vec3f(scene.frame.toLocal({0, 1, 0})), {0, 1, 0}, kNone}, PhotonSampler(1, 0)), Rgb{});
}

TEST(AlphaTransport, ADoubleSidedPaintedSkyKeepsTheSunOut) {
  const Scene scene = paintedSky(true);
  const PhotonScene photons(scene);
  FluxMeter meter(1, [](const PhotonHit& h) { return h.hit.material; });
  test::expectBalance(test::fly(photons, 20'000, meter));
  EXPECT_EQ(meter[0].sum, 0);
}

/// Flux of a lamp of 1 × 1 m, on average over its photons, lm.
void expectLampFlux(const Scene& scene, double expected) {
  const PhotonScene photons(scene);
  test::Mean beta;
  for (std::uint64_t i = 0; i < 200'000; ++i)
    beta.add(static_cast<double>(mean(photons.emitters().sample(PhotonSampler(4, i).emission()).beta)));
  test::expectMean(beta, expected / photons.emitters().totalFlux(), 3, 1e-6);
  const Ledger l = test::fly(photons, 50'000);
  test::expectBalance(l);
}

Scene lampWithAlpha(AlphaMode mode, float alpha, bool textured, bool doubleSided) {
  SceneBuilder b;
  test::addPlate(b, -1, 2, b.addDiffuse(Rgb(0.5f)));
  Material m = screenMaterial(mode, alpha);
  m.emissive = Rgb(100.f);
  m.doubleSided = doubleSided;
  const auto lamp = b.addMaterial(m);
  test::addPlate(b, 1, 0.5, lamp);
  Scene scene = b.build();
  if (textured) scene.materials[lamp].baseColorTexture = test::addTexture(scene, 8, maskTexel, true);
  return scene;
}

TEST(AlphaTransport, LampsEmitOnlyWhereTheyCover) {
  expectLampFlux(lampWithAlpha(AlphaMode::mask, 1, true, false), kPi64 * 100 * 3 / 8);
  expectLampFlux(lampWithAlpha(AlphaMode::blend, 0.3f, false, false), kPi64 * 100 * 0.3);
  expectLampFlux(lampWithAlpha(AlphaMode::blend, 0.3f, true, true), 2 * kPi64 * 100 * 0.3 * 3 / 8);
}

TEST(AlphaTransport, NoPhotonStartsInAHole) {
  const Scene scene = lampWithAlpha(AlphaMode::mask, 1, true, false);
  const PhotonScene photons(scene);
  for (std::uint64_t i = 0; i < 50'000; ++i) {
    const EmittedPhoton p = photons.emitters().sample(PhotonSampler(4, i).emission());
    const Vec3d at = scene.frame.toWorld(p.position);
    const auto texel = [](double u) { return std::clamp(static_cast<int>(u * 8), 0, 7); };
    ASSERT_TRUE(maxComponent(p.beta) <= 0 || isThere(texel(at.x + 0.5), texel(0.5 - at.z))) << i;
  }
}

}  // namespace
}  // namespace lucarne::alpha_transport_test
