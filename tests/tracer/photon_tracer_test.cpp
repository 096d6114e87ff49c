#include "tracer/transport/photon_tracer.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/scene_builder.h"
#include "tests/support/statistics.h"
#include "tracer/transport/any_sink.h"

namespace lucarne::photon_tracer_test {
namespace {

using test::SceneBuilder;

struct NoSink {
  void hit(const PhotonHit&) {}
  void endPhoton() {}
};

struct RecordingSink {
  std::vector<float> numbers;
  void hit(const PhotonHit& h) {
    for (const float v : {h.beta.x, h.wi.x, h.wi.y, static_cast<float>(h.hit.position.x), static_cast<float>(h.hit.triangle)})
      numbers.push_back(v);
  }
  void endPhoton() { numbers.push_back(-1); }
};

SceneBuilder room(float albedo, bool glossy) {
  SceneBuilder b;
  Material m = test::diffuseMaterial({albedo, 0.7f * albedo, 0.4f * albedo});
  if (glossy) {
    m.specular = 1;
    m.roughness = 0.3f;
  }
  b.addBox({0, 0, 0}, {4, 3, 5}, b.addMaterial(m), true);
  const auto lamp = b.addDiffuse(Rgb(0.1f), {900, 700, 500});
  b.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, lamp, false);
  b.addBox({0.5, 0.01, 0.5}, {1.5, 1, 1.5}, b.addDiffuse({0.2f, 0.5f, 0.9f}), false);
  return b;
}

Ledger traceAll(const Scene& scene, std::uint64_t photons, TraceLimits limits = {}) {
  const PhotonScene photonScene(scene);
  Ledger ledger;
  NoSink sink;
  flyPhotons(photonScene, {0, photons}, 1, limits, sink, ledger);
  return ledger;
}

TEST(PhotonTracer, LedgerBalancesExactlyWithEveryKindOfSurface) {
  for (const bool glossy : {false, true}) {
    const Ledger ledger = traceAll(room(0.8f, glossy).build(), 20000);
    EXPECT_EQ(ledger.photons, 20000u);
    EXPECT_TRUE(ledger.balance() == ledger.emitted);
    EXPECT_EQ(ledger.strayValues, 0u);
    EXPECT_TRUE(ledger.escaped.units[0] == 0) << "a closed room";
  }
}

TEST(PhotonTracer, AbsorptionIsTheExpectedOneWithinFourStandardErrors) {
  for (const bool glossy : {false, true}) {
    const Ledger l = traceAll(room(0.8f, glossy).build(), 100000);
    double difference = 0;
    for (std::size_t c = 0; c < 3; ++c) difference += static_cast<double>(l.absorbed.units[c] - l.expectedAbsorbed.units[c]);
    const double se = std::sqrt(static_cast<double>(l.absorptionErrorSquares));
    EXPECT_LT(std::abs(difference), 4 * se + 1) << "glossy " << glossy;
  }
}

TEST(PhotonTracer, RouletteIsZeroOnAverage) {
  const Ledger l = traceAll(room(0.5f, false).build(), 100000);
  // Every survivor lends up to one photon's flux and every casualty pays it back.
  const double units = static_cast<double>(l.roulette.units[0]), one = static_cast<double>(l.emitted.units[0]) / 100000;
  EXPECT_LT(std::abs(units), 4 * one * std::sqrt(static_cast<double>(l.hits)));
}

TEST(PhotonTracer, APhotonIsAFunctionOfItsIndexAlone) {
  const Scene scene = room(0.8f, true).build();
  const PhotonScene photonScene(scene);
  const auto run = [&](IndexRange r) {
    Ledger ledger;
    RecordingSink sink;
    flyPhotons(photonScene, r, 5, {}, sink, ledger);
    return sink.numbers;
  };
  std::vector<float> pieces = run({1ull << 40, (1ull << 40) + 7});
  const std::vector<float> rest = run({(1ull << 40) + 7, (1ull << 40) + 50});
  pieces.insert(pieces.end(), rest.begin(), rest.end());
  EXPECT_EQ(pieces, run({1ull << 40, (1ull << 40) + 50}));
}

TEST(PhotonTracer, AWhiteClosedRoomEndsAndTheRestIsBooked) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {1, 1, 1}, b.addDiffuse(Rgb(1.f), Rgb(1.f)), true);
  const Ledger l = traceAll(b.build(), 100, {200});
  EXPECT_EQ(l.cutOffPaths, 100u);
  EXPECT_TRUE(l.cutOff == l.emitted);
  EXPECT_TRUE(l.balance() == l.emitted);
}

TEST(PhotonTracer, BacksOfOneSidedSurfacesAbsorb) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {1, 1, 1}, b.addDiffuse(Rgb(0.9f)), false);  // fronts look out, the light is inside
  Light l;
  l.position = {0.5, 0.5, 0.5};
  b.addLight(l);
  const Ledger ledger = traceAll(b.build(), 1000);
  EXPECT_TRUE(ledger.absorbed == ledger.emitted);
  EXPECT_EQ(ledger.rays, 1000u);
}

TEST(PhotonTracer, NoRayLeavesAClosedRoomEvenAtItsEdgesAndFarAway) {
  for (const double offset : {0.0, 1e7}) {
    SceneBuilder b;
    const Vec3d o{offset, -offset, offset};
    b.addBox(o, o + Vec3d{4, 3, 5}, b.addDiffuse(Rgb(0.9f), Rgb(1.f)), true);
    const Ledger l = traceAll(b.build(), 100000);
    EXPECT_TRUE(l.escaped.units[0] == 0) << l.rays << " rays, offset " << offset;
  }
}

// Scaling by a power of two changes nothing at all; other scales only rounding.
TEST(PhotonTracer, ScaleOfTheSceneDoesNotMatter) {
  const auto run = [](double s) {
    SceneBuilder b;
    b.addBox({0, 0, 0}, Vec3d{4, 3, 5} * s, b.addDiffuse(Rgb(0.5f), Rgb(1.f)), true);
    return traceAll(b.build(), 5000);
  };
  const Ledger unit = run(1);
  EXPECT_TRUE(run(0x1p20).absorbed == unit.absorbed);
  EXPECT_TRUE(run(0x1p-20).absorbed == unit.absorbed);
  EXPECT_NEAR(static_cast<double>(run(1e-6).hits), static_cast<double>(unit.hits), 0.05 * static_cast<double>(unit.hits));
}

}  // namespace
}  // namespace lucarne::photon_tracer_test
