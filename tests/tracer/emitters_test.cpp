#include "tracer/optics/emitters.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/scene_builder.h"
#include "tests/support/statistics.h"
#include "tracer/optics/sampler.h"

namespace lucarne::emitters_test {
namespace {

using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;

EmissionNumbers numbers(std::uint64_t i) { return PhotonSampler(11, i).emission(); }

Light light(LightKind kind, Rgb intensity) {
  Light l;
  l.kind = kind;
  l.intensity = intensity;
  l.position = {0, 1, 0};
  l.direction = normalize(Vec3d{0.1, -1, 0.2});
  return l;
}

struct Table {
  explicit Table(const SceneBuilder& builder) : scene(builder.build()), surfaces(scene), emitters(scene, surfaces) {}
  Scene scene;
  SurfaceTable surfaces;
  EmitterTable emitters;
};

SceneBuilder floorScene() {
  SceneBuilder b;
  const auto grey = b.addDiffuse(Rgb(0.5f));
  b.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, grey);
  return b;
}

TEST(EmitterTable, TotalFluxIsTheClosedForm) {
  SceneBuilder b = floorScene();
  const auto lamp = b.addDiffuse(Rgb(0.f), {300, 600, 900});
  b.addQuad({0, 2, 0}, {0.5, 2, 0}, {0.5, 2, 0.4}, {0, 2, 0.4}, lamp);
  EXPECT_NEAR(Table(b).emitters.totalFlux(), kPi64 * 600 * 0.2, 1e-3);
  b.addLight(light(LightKind::point, {10, 20, 60}));
  EXPECT_NEAR(Table(b).emitters.totalFlux(), kPi64 * 600 * 0.2 + 4 * kPi64 * 30, 1e-3);
}

TEST(EmitterTable, DoubleSidedLampsGiveTwiceTheFluxOnBothSides) {
  SceneBuilder b = floorScene();
  Material m = test::diffuseMaterial(Rgb(0.f), Rgb(100.f));
  m.doubleSided = true;
  b.addQuad({0, 2, 0}, {1, 2, 0}, {1, 2, 1}, {0, 2, 1}, b.addMaterial(m));
  const Table t(b);
  EXPECT_NEAR(t.emitters.totalFlux(), 2 * kPi64 * 100, 1e-4);
  int up = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) up += t.emitters.sample(numbers(i)).direction.y > 0;
  EXPECT_NEAR(up, 5000, 50 * test::zThreshold(1));
}

TEST(EmitterTable, SpotPhotonsCarryTheSameFluxAndFollowTheFalloff) {
  Light l = light(LightKind::spot, Rgb(100.f));
  l.cosInner = 0.9;
  l.cosOuter = 0.6;
  SceneBuilder b = floorScene();
  b.addLight(l);
  const Table t(b);
  EXPECT_NEAR(t.emitters.totalFlux(), 100 * 2 * kPi64 * (0.1 + 0.1), 1e-4);
  constexpr int bins = 40, samples = 200000;
  std::vector<double> observed(bins, 0), expected(bins, 0);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const EmittedPhoton p = t.emitters.sample(numbers(i));
    EXPECT_NEAR(p.beta.x, 1.f, 1e-5f);
    const double c = dot(Vec3d(p.direction), l.direction);
    ASSERT_GE(c, 0.6 - 1e-5);
    ++observed[std::min<std::size_t>(bins - 1, static_cast<std::size_t>((std::max(c, 0.6) - 0.6) / 0.4 * bins))];
  }
  for (int k = 0; k < bins * 100; ++k) {
    const double c = 0.6 + 0.4 * (k + 0.5) / (bins * 100), ramp = std::clamp((c - 0.6) / 0.3, 0.0, 1.0);
    expected[static_cast<std::size_t>(k / 100)] += samples * ramp * ramp * (0.4 / (bins * 100)) / 0.2;
  }
  EXPECT_GT(test::chiSquareP(observed, expected), 1e-4);
}

TEST(EmitterTable, PicksInProportionToFluxAndKeepsTheOrder) {
  SceneBuilder b = floorScene();
  std::vector<double> weights{0.5, 3, 1e-3, 7, 2};
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const auto lamp = b.addDiffuse(Rgb(0.f), Rgb(static_cast<float>(weights[k])));
    const double x = static_cast<double>(k);
    b.addTriangle({x, 2, 0}, {x + 1, 2, 0}, {x, 2, 1}, lamp);
  }
  const Table t(b);
  std::uint32_t last = 0;
  std::vector<double> observed(weights.size(), 0), expected;
  constexpr int samples = 100000;
  for (int i = 0; i < samples; ++i) {
    const auto p = t.emitters.sample({(i + 0.5) / samples, {0.3f, 0.5f, 0.5f}});
    EXPECT_GE(p.triangle, last);
    last = p.triangle;
    ++observed[p.triangle - 2];
  }
  for (std::size_t k = 0; k < weights.size(); ++k) EXPECT_NEAR(observed[k], samples * weights[k] / 12.501, 2);
}

TEST(EmitterTable, TexturedLampEmitsTheMeanOfItsTexture) {
  SceneBuilder b = floorScene();
  Material m = test::diffuseMaterial(Rgb(0.f), Rgb(100.f));
  m.emissiveTexture.texture = 0;
  b.addQuad({0, 2, 0}, {1, 2, 0}, {1, 2, 1}, {0, 2, 1}, b.addMaterial(m));
  Scene scene = b.build();
  Image image{64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 0)};  // black but for one bright texel in 64
  for (std::size_t y = 0; y < 64; y += 8)
    for (std::size_t x = 0; x < 64; x += 8) image.rgba[4 * (y * 64 + x)] = 255;
  scene.images.push_back(image);
  scene.textures.push_back({0, Wrap::repeat, Wrap::repeat, true});
  const SurfaceTable surfaces(scene);
  const EmitterTable emitters(scene, surfaces);
  double sum = 0, squares = 0;
  constexpr int samples = 200000;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const double v = static_cast<double>(emitters.sample(numbers(i)).beta.x);
    sum += v;
    squares += v * v;
  }
  const double m1 = sum / samples, se = std::sqrt((squares / samples - m1 * m1) / samples);
  EXPECT_NEAR(m1 * emitters.totalFlux(), kPi64 * 100 / 64, test::zThreshold(1) * se * emitters.totalFlux());
}

TEST(EmitterTable, ASceneWithoutLightHasNoEmittersAndDarkLightsAreNamed) {
  SceneBuilder b = floorScene();
  Light l = light(LightKind::point, Rgb(0.f));
  l.name = "off";
  b.addLight(l);
  const Table t(b);
  EXPECT_TRUE(t.emitters.empty());
  EXPECT_EQ(t.emitters.dark(), std::vector<std::string>{"off"});
}

}  // namespace
}  // namespace lucarne::emitters_test
