// A scene gives the same photons with every variant of the tracing loop that does what it needs.
#include "tracer/transport/photon_variants.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/app/truth_scenes.h"
#include "tests/tracer/photon_runs.h"

namespace lucarne::photon_variants_test {
namespace {

struct VariantScene {
  std::string name;
  std::size_t variant;  // that is meant for it
  Scene scene;
};

class Recorder {
 public:
  void hit(const PhotonHit& h) {
    for (const Vec3f& v : {h.beta, h.wi, h.n, h.ns, Vec3f(h.hit.position)}) add(v);
    numbers_.push_back(h.hit.b.x);
    numbers_.push_back(h.hit.b.y);
    whole_.insert(whole_.end(), {h.hit.triangle, h.event, h.hit.back ? 1u : 0u});
    whole_.insert(whole_.end(), h.words.begin(), h.words.end());
  }
  void endPhoton() { whole_.push_back(kNone); }
  friend bool operator==(const Recorder&, const Recorder&) = default;
  std::size_t size() const { return whole_.size(); }

 private:
  void add(Vec3f v) { numbers_.insert(numbers_.end(), {v.x, v.y, v.z}); }
  std::vector<float> numbers_;
  std::vector<std::uint32_t> whole_;
};

bool sameLedger(const Ledger& a, const Ledger& b) {
  return a.emitted == b.emitted && a.absorbed == b.absorbed && a.escaped == b.escaped && a.cutOff == b.cutOff &&
         a.roulette == b.roulette && a.shadingNormal == b.shadingNormal && a.expectedAbsorbed == b.expectedAbsorbed &&
         a.absorptionErrorSquares == b.absorptionErrorSquares && a.photons == b.photons && a.rays == b.rays &&
         a.hits == b.hits && a.cutOffPaths == b.cutOffPaths && a.repeatedRays == b.repeatedRays &&
         a.clampedNormals == b.clampedNormals && a.strayValues == b.strayValues;
}

Scene texturedRoom(const Material& walls) {
  Scene s = test::lampRoom(walls).build();
  s.materials[0].baseColorTexture = test::addTexture(s, 8, [](int x, int y) {
    return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(100 + 15 * x), static_cast<std::uint8_t>(240 - 20 * y),
                                       180, 255};
  });
  return s;
}

/// A screen with holes and a block of glass in a room of painted, bumpy, coated walls.
Scene roomOfAll() {
  test::SceneBuilder b = test::lampRoom(test::glossyMaterial({0.6f, 0.5f, 0.4f}, 0.4f));
  Material green = test::glassMaterial(true, 0.1f);
  green.attenuationColor = {0.3f, 0.9f, 0.5f};
  green.attenuationDistance = 1;
  test::addBlock(b, green);
  Material screen = test::diffuseMaterial({0.7f, 0.5f, 0.3f});
  screen.doubleSided = true;
  screen.alphaMode = AlphaMode::blend;
  screen.alpha = 0.4f;
  b.addQuad({0.5, 2, 1}, {3.5, 2, 1}, {3.5, 2, 4}, {0.5, 2, 4}, b.addMaterial(screen));
  Scene s = b.build();
  const auto code = [](int i) { return static_cast<std::uint8_t>(100 + 20 * (i % 4)); };
  s.materials[0].normalTexture = test::addTexture(s, 8, [&](int x, int y) {
    return std::array<std::uint8_t, 4>{code(x), code(y), 225, 255};
  });
  s.materials[0].baseColorTexture = test::addTexture(s, 8, [&](int x, int y) {
    return std::array<std::uint8_t, 4>{code(y), code(x), 250, 255};
  });
  test::addTangents(s);
  return s;
}

std::vector<VariantScene> variantScenes() {
  const auto glassRoom = [] {
    test::SceneBuilder b = test::lampRoom(test::diffuseMaterial(Rgb(0.6f)));
    test::addBlock(b, test::glassMaterial(true, 0.1f, {0.9f, 0.8f, 0.7f}));
    return b.build();
  };
  Scene texturedScreen = test::screenRoom(AlphaMode::mask);
  Scene bumpyScreen = test::bumpRoom();
  bumpyScreen.materials[1].alphaMode = AlphaMode::blend;
  bumpyScreen.materials[1].alpha = 0.5f;
  return {
      {"diffuse", 0, test::lampRoom(test::diffuseMaterial({0.7f, 0.6f, 0.5f})).build()},
      {"smooth coated", 1, test::sphereRoom()},
      {"coated", 1, test::lampRoom(test::glossyMaterial({0.5f, 0.5f, 0.6f}, 0.35f)).build()},
      {"painted", 2, texturedRoom(test::diffuseMaterial(Rgb(0.8f)))},
      {"painted and coated", 2, texturedRoom(test::glossyMaterial(Rgb(0.8f), 0.3f))},
      {"glass", 3, glassRoom()},
      {"alpha mask", 4, std::move(texturedScreen)},
      {"alpha blend", 4, test::screenRoom(AlphaMode::blend)},
      {"normal maps", 5, test::bumpRoom()},
      {"normal maps and alpha", 6, std::move(bumpyScreen)},
      {"all", kGeneralVariant, roomOfAll()},
  };
}

struct Flight {
  Recorder record;
  Ledger ledger;
};

Flight fly(const PhotonScene& scene, std::size_t variant, SamplerKind kind) {
  Flight flight;
  flyPhotons(scene, {100, 3100}, PhotonSeed(5, kind), {}, flight.record, flight.ledger, variant);
  return flight;
}

TEST(PhotonVariants, ThatCoverASceneGiveTheSameBitsAsTheGeneralOne) {
  for (const VariantScene& v : variantScenes()) {
    const PhotonScene scene(v.scene);
    for (const SamplerKind kind : {SamplerKind::random, SamplerKind::sobol}) {
      const Flight general = fly(scene, kGeneralVariant, kind);
      EXPECT_GT(general.ledger.hits, 3000u);
      test::expectBalance(general.ledger);
      for (std::size_t i = 0; i < kGeneralVariant; ++i) {
        if (!covers(kPhotonVariants[i].features, scene.surfaces().features())) continue;
        const Flight lean = fly(scene, i, kind);
        EXPECT_TRUE(lean.record == general.record) << v.name << " with variant " << kPhotonVariants[i].name;
        EXPECT_TRUE(sameLedger(lean.ledger, general.ledger)) << v.name << " with variant " << kPhotonVariants[i].name;
      }
    }
  }
}

TEST(PhotonVariants, EachSceneGetsTheOneMeantForIt) {
  for (const VariantScene& v : variantScenes()) {
    const SurfaceTable surfaces(v.scene);
    EXPECT_STREQ(kPhotonVariants[photonVariantFor(surfaces.features())].name, kPhotonVariants[v.variant].name)
        << v.name;
  }
}

// Each scene does need its variant: the comparison above can fail.
TEST(PhotonVariants, ThatLackWhatASceneNeedsGiveOtherPhotons) {
  for (const VariantScene& v : variantScenes()) {
    if (v.variant == 0) continue;
    const PhotonScene scene(v.scene);
    const Flight general = fly(scene, kGeneralVariant, SamplerKind::random);
    EXPECT_FALSE(fly(scene, 0, SamplerKind::random).record == general.record) << v.name;
  }
}

int count(const SceneFeatures& f) { return f.coats + f.textures + f.normalMaps + f.holes + f.transmission; }

TEST(PhotonVariants, TheLeanestThatDoesIsTaken) {
  static_assert(kPhotonVariants.size() <= 8);
  for (unsigned bits = 0; bits < 32; ++bits) {
    const SceneFeatures needs{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
    const SceneFeatures& chosen = kPhotonVariants[photonVariantFor(needs)].features;
    EXPECT_TRUE(covers(chosen, needs)) << bits;
    for (const PhotonVariant& other : kPhotonVariants)
      EXPECT_TRUE(!covers(other.features, needs) || count(other.features) >= count(chosen))
          << bits << ' ' << other.name;
  }
}

}  // namespace
}  // namespace lucarne::photon_variants_test
