// Normal maps turn what a surface receives, and where glossy light goes, and let nothing through.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/textures.h"
#include "tests/tracer/photon_runs.h"
#include "tracer/transport/shading_normal.h"

namespace lucarne::normal_map_test {
namespace {

using test::FluxMeter;
using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;

using Texel = std::array<std::uint8_t, 4>;

std::uint8_t code(double component) { return static_cast<std::uint8_t>(std::lround((component + 1) * 127.5)); }

/// A closed room with a lamp in it; walls with a normal map that `texel(x, y)` gives, none if empty.
Scene mappedRoom(const Material& walls, const std::function<Texel(int, int)>& texel) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 5}, b.addMaterial(walls), true);
  b.addLight(test::bulbLight({1.5, 2, 2}, {90, 70, 50}));
  Scene s = b.build();
  if (texel) {
    s.materials[0].normalTexture = test::addTexture(s, 8, texel);
    test::addTangents(s);
  }
  return s;
}

/// Hits 1 and 2 of each photon.
struct FirstBounce {
  struct Pair {
    Vec3f normal{}, onward{};
    bool whole = false;
  };
  std::vector<Pair> pairs{1};
  void hit(const PhotonHit& h) {
    if (h.event == 1) pairs.back().normal = h.n;
    if (h.event == 2) {
      pairs.back().onward = -h.wi;
      pairs.back().whole = true;
    }
  }
  void endPhoton() { pairs.emplace_back(); }
};

// (128, 128, 255) is as near to +z as codes get: (1, 1, 255)/255 off by 0.0055.
TEST(NormalMaps, AFlatMapChangesNothingBeyondTheRoundingOfItsCodes) {
  constexpr double kOff = 0.0056;
  for (const float specular : {0.f, 1.f}) {
    Material m = test::diffuseMaterial({0.7f, 0.6f, 0.5f});
    m.specular = specular;
    m.roughness = 0.6f;
    const Scene plain = mappedRoom(m, {}), mapped = mappedRoom(m, [](int, int) { return Texel{128, 128, 255, 255}; });
    const PhotonScene plainPhotons(plain), mappedPhotons(mapped);
    ASSERT_TRUE(mappedPhotons.surfaces().features().normalMaps);
    const auto place = [](const PhotonHit& h) { return h.hit.triangle / 2; };
    FluxMeter plainFlux(6, place), mappedFlux(6, place);
    test::expectBalance(test::fly(plainPhotons, 100'000, plainFlux, 1));
    test::expectBalance(test::fly(mappedPhotons, 100'000, mappedFlux, 2));
    for (std::size_t w = 0; w < 6; ++w) {
      const double se = std::hypot(plainFlux[w].error(), mappedFlux[w].error());
      EXPECT_NEAR(mappedFlux[w].mean(), plainFlux[w].mean(), test::zThreshold(12) * se + kOff * plainFlux[w].mean())
          << w;
    }
    if (specular > 0) continue;
    FirstBounce a, b;
    test::fly(plainPhotons, 5'000, a);
    test::fly(mappedPhotons, 5'000, b);
    std::size_t both = 0;
    for (std::size_t i = 0; i < a.pairs.size(); ++i) {
      if (!a.pairs[i].whole || !b.pairs[i].whole) continue;
      ++both;
      ASSERT_NEAR(dot(a.pairs[i].normal, a.pairs[i].onward), dot(b.pairs[i].normal, b.pairs[i].onward), kOff) << i;
    }
    EXPECT_GT(both, 2'500u);
  }
}

/// A plate in the middle of a black box, under a narrow beam from the zenith, its normals tilted by the map.
struct TiltedPlate {
  TiltedPlate(Material m, Vec3d tilt) {
    SceneBuilder b;
    test::addPlate(b, 0, 1, b.addMaterial(m));
    b.addBox({-20, -20, -20}, {20, 20, 20}, b.addDiffuse(Rgb(0.f)), true);
    Light beam = test::bulbLight({0, 10, 0}, Rgb(1e6f));
    beam.kind = LightKind::spot;
    beam.direction = {0, -1, 0};
    beam.cosInner = 1 - 1e-8;
    beam.cosOuter = 1 - 2e-8;
    b.addLight(beam);
    scene = b.build();
    const Texel texel{code(tilt.x), code(tilt.y), code(tilt.z), 255};
    scene.materials[0].normalTexture = test::addTexture(scene, 1, [&](int, int) { return texel; });
    test::addTangents(scene);
    const auto component = [](std::uint8_t c) { return c / 127.5 - 1; };
    // Texture x runs along +x; up in the map, −v, is +z here (v runs from z = 1 to z = −1).
    normal = normalize(Vec3d{component(texel[0]), component(texel[2]), component(texel[1])});
  }
  Scene scene;
  Vec3d normal;
};

/// Flux that leaves the plate: how much, and its mean direction.
struct Leaving {
  double beta = 0;
  Vec3d direction{};
  double below = 0;
  void hit(const PhotonHit& h) {
    if (h.event < 2) return;
    const auto b = static_cast<double>(h.beta.x);
    beta += b;
    direction += Vec3d(-h.wi) * b;
    if (-h.wi.y <= 0) below += b;
  }
  void endPhoton() {}
};

/// Share of light from the zenith that a diffuse plate sends on: ∫ a·(ns·wi)/(n·wi) · (wo·n)/π over directions above
/// both, the correction clamped.
double diffuseShare(Vec3d ns, double albedo) {
  double sum = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double y = (i + 0.5) / kSteps, azimuth = 2 * kPi64 * (j + 0.5) / kSteps, r = std::sqrt(1 - y * y);
      const Vec3d wo{r * std::cos(azimuth), y, r * std::sin(azimuth)};
      const double woNs = dot(wo, ns);
      if (woNs <= 0) continue;
      sum += woNs * std::min(ns.y * y / woNs, static_cast<double>(kLargestShadingCorrection));
    }
  return albedo * 2 * sum / (kSteps * kSteps);
}

TEST(NormalMaps, DiffuseLightChangesByWhatTheTiltedNormalReceives) {
  for (const Vec3d& tilt : {Vec3d{0.5, 0, 0.86}, Vec3d{0, -0.7, 0.7}, Vec3d{-0.3, 0.3, 0.9}}) {
    const TiltedPlate plate(test::diffuseMaterial(Rgb(0.8f)), tilt);
    Leaving leaving;
    constexpr int kPhotons = 200'000;
    const Ledger l = test::fly(PhotonScene(plate.scene), kPhotons, leaving);
    test::expectBalance(l);
    EXPECT_NE(l.shadingNormal.units[0], 0);
    EXPECT_EQ(leaving.below, 0) << "nothing goes through the plate";
    const double expected = diffuseShare(plate.normal, 0.8);
    EXPECT_NEAR(leaving.beta / kPhotons, expected, test::zThreshold(3) * std::sqrt(2.0 / kPhotons)) << plate.normal.y;
  }
}

// A rough mirror shows where the normal points: flux goes about the mirror image in the tilted normal.
TEST(NormalMaps, GlossyLightGoesAboutTheMirrorImageInTheTiltedNormal) {
  Material metal = test::diffuseMaterial(Rgb(0.9f));
  metal.metallic = 1;
  metal.specular = 1;
  metal.roughness = 0.15f;
  for (const Vec3d& tilt : {Vec3d{0.3, 0, 0.95}, Vec3d{0, 0.3, 0.95}, Vec3d{-0.2, -0.3, 0.93}}) {
    const TiltedPlate plate(metal, tilt);
    Leaving leaving;
    const Ledger l = test::fly(PhotonScene(plate.scene), 50'000, leaving);
    test::expectBalance(l);
    const Vec3d mirror = plate.normal * (2 * plate.normal.y) - Vec3d{0, 1, 0};
    EXPECT_GT(dot(normalize(leaving.direction), mirror), std::cos(3 * kPi64 / 180));
    EXPECT_EQ(leaving.below, 0);
  }
}

TEST(NormalMaps, NoLightLeavesAClosedRoomThroughItsBumps) {
  const auto bumps = [](int x, int y) {
    const auto tilt = [](int i) { return static_cast<std::uint8_t>(40 + 58 * (i % 4)); };
    return Texel{tilt(x), tilt(y + x), static_cast<std::uint8_t>(128 + 20 * (x % 3)), 255};
  };
  for (const float specular : {0.f, 1.f}) {
    Material m = test::diffuseMaterial({0.9f, 0.8f, 0.7f});
    m.specular = specular;
    m.roughness = 0.3f;
    const Scene scene = mappedRoom(m, bumps);
    std::uint64_t backs = 0;
    const auto place = [&](const PhotonHit& h) {
      backs += h.hit.back;
      return 0;
    };
    FluxMeter meter(1, place);
    const Ledger l = test::fly(PhotonScene(scene), 100'000, meter);
    test::expectBalance(l);
    test::expectNothingEscapes(l);
    EXPECT_EQ(backs, 0u);
    EXPECT_GT(l.clampedNormals, 0u);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NE(l.shadingNormal.units[c], 0);
  }
}

}  // namespace
}  // namespace lucarne::normal_map_test
