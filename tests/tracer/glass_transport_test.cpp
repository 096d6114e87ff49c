// Light through glass, against closed forms of geometric optics. Smooth glass is GGX at its least α: directions are off
// by about 0.1°.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/app/truth_scenes.h"
#include "tests/tracer/photon_runs.h"

namespace lucarne::glass_transport_test {
namespace {

using test::FluxMeter;
using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;

Material black() { return test::diffuseMaterial(Rgb(0.f)); }
Material clearGlass(float roughness = 0) { return test::glassMaterial(true, roughness); }

/// Fresnel's share, unpolarised, from air (n = 1) into `n`, by the textbook (Hecht 2017, equations 4.34 and 4.40).
double fresnel(double cosI, double n) {
  const double sinT = std::sqrt(1 - cosI * cosI) / n;
  if (sinT >= 1) return 1;
  const double cosT = std::sqrt(1 - sinT * sinT);
  const double s = (cosI - n * cosT) / (cosI + n * cosT), p = (n * cosI - cosT) / (n * cosI + cosT);
  return 0.5 * (s * s + p * p);
}

/// All three channels of FluxMeter's mean, one after the other.
template <class Inside>
struct ChannelMeter {
  Inside inside;
  Rgbd photon{};
  std::array<test::Mean, 3> flux{};
  void hit(const PhotonHit& h) {
    if (inside(h)) photon += Rgbd(h.beta);
  }
  void endPhoton() {
    for (int c = 0; c < 3; ++c) flux[static_cast<std::size_t>(c)].add(photon[c]);
    photon = {};
  }
};

TEST(GlassTransport, AClearBlockInAClosedRoomTakesNothing) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {4, 3, 5}, b.addDiffuse(Rgb(0.5f)), true);
  test::addBlock(b, clearGlass());
  b.addLight(test::bulbLight({2, 2.5, 1}, Rgb(100.f)));
  const Scene scene = b.build();
  FluxMeter meter(2, [](const PhotonHit& h) { return h.hit.material; });
  const Ledger l = test::fly(PhotonScene(scene), 100'000, meter);
  test::expectBalance(l);
  test::expectNothingEscapes(l);
  EXPECT_LT(test::share(l.cutOff, l), 1e-3) << "kept inside by total reflection";
  EXPECT_GT(meter[1].mean(), 0.2) << "the block is met";
  const double byGlass = test::share(l.absorbed, l) - 0.5 * meter[0].mean();
  EXPECT_GT(byGlass, -1e-6);
  EXPECT_LT(byGlass, 1e-3 * meter[1].mean());
}

struct Slab {
  Rgb left;  // of white light that goes straight through
  double thickness;
  std::string name;
};

/// A wide slab over a black floor under a sun that stands in the zenith.
Scene slabUnderTheSun(const Slab& slab, float ior) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addMaterial(black()));
  Material m = clearGlass();
  m.ior = ior;
  m.attenuationColor = slab.left;
  m.attenuationDistance = slab.thickness;
  b.addBox({-1, 0.5, -1}, {1, 0.5 + slab.thickness, 1}, b.addMaterial(m), false);
  b.addLight(test::sunLight({0, -1, 0}, Rgb(1000.f)));
  return b.build();
}

// T = (1 − F)²·a / (1 − F²·a²): the sum over all ways to and fro inside, a what the slab leaves of one way.
TEST(GlassTransport, ASlabTransmitsTheSumOfAllInnerReflections) {
  for (const float ior : {1.5f, 2.4f})
    for (const Slab& slab : {Slab{Rgb(1.f), 0.2, "clear"}, Slab{{0.9f, 0.5f, 0.1f}, 0.2, "tinted"}}) {
      const Scene scene = slabUnderTheSun(slab, ior);
      const PhotonScene photons(scene);
      const auto middle = [&](const PhotonHit& h) {
        const Vec3d p = scene.frame.toWorld(h.hit.position);
        return h.hit.material == 0 && std::abs(p.x) < 0.5 && std::abs(p.z) < 0.5;
      };
      ChannelMeter<decltype(middle)> meter{middle};
      const Ledger l = test::fly(photons, 400'000, meter, PhotonSeed(1, SamplerKind::random));
      test::expectBalance(l);
      const double f = fresnel(1, static_cast<double>(ior));
      for (std::size_t c = 0; c < 3; ++c) {
        const auto a = static_cast<double>(slab.left[static_cast<int>(c)]);
        const double t = (1 - f) * (1 - f) * a / (1 - f * f * a * a);
        const double middleFlux = 1000.0 / photons.emitters().totalFlux();  // 1 m² of it
        const double se = meter.flux[c].error();
        EXPECT_NEAR(meter.flux[c].mean(), middleFlux * t, test::zThreshold(12) * se + 1e-3 * middleFlux * t)
            << slab.name << ' ' << ior << " channel " << c;
      }
    }
}

// A lamp in the middle of a cube of glass: through each face goes light within the critical angle, less Fresnel's
// share; the six cones do not overlap for n = 1.5. All else goes round inside for ever.
TEST(GlassTransport, TotalReflectionKeepsLightInABlock) {
  SceneBuilder b;
  b.addBox({-2, -2, -2}, {2, 2, 2}, b.addMaterial(black()), true);
  b.addBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, b.addMaterial(clearGlass()), false);
  b.addLight(test::bulbLight({0, 0, 0}, Rgb(100.f)));
  const Scene scene = b.build();
  const PhotonScene photons(scene);
  const double critical = std::sqrt(1 - 1 / (1.5 * 1.5));  // its cosine
  double direct = 0;
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double c = critical + (1 - critical) * (i + 0.5) / kSteps;  // inside; the same share from outside
    const double outside = std::sqrt(1 - (1 - c * c) * 1.5 * 1.5);
    direct += 3 * (1 - fresnel(outside, 1.5)) * (1 - critical) / kSteps;
  }
  const auto place = [](const PhotonHit& h) { return h.hit.material == 0 ? (h.event == 2 ? 0u : 1u) : 2u; };
  FluxMeter meter(2, place);
  const Ledger l = test::fly(photons, 100'000, meter, 1, {24});
  test::expectBalance(l);
  test::expectNothingEscapes(l);
  test::expectMean(meter[0], direct, 2, 2e-3);
  const double trapped = 1 - 3 * (1 - critical) * 2 / 2;
  EXPECT_NEAR(test::share(l.cutOff, l), trapped, 0.02) << "of 24 reflections";
}

/// Where light of a beam at 60° from the vertical meets the floor 0.1 m below a pane: flux near the straight place, and
/// near the place shifted by a slab of 2 cm.
struct PaneResult {
  test::Mean straight, shifted;
};
PaneResult beamThrough(const Material& pane, bool solid) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addMaterial(black()));
  const auto glass = b.addMaterial(pane);
  if (solid) {
    b.addBox({-1, 0.1, -1}, {1, 0.12, 1}, glass, false);
  } else {
    test::addPlate(b, 0.11, 1, glass);
  }
  Light beam = test::bulbLight({-std::sqrt(3.0) * 0.5, 0.5, 0}, Rgb(1e6f));
  beam.kind = LightKind::spot;
  beam.direction = normalize(Vec3d{std::sqrt(3.0), -1, 0});
  beam.cosInner = 1 - 1e-9;
  beam.cosOuter = 1 - 2e-9;
  b.addLight(beam);
  const Scene scene = b.build();
  const PhotonScene photons(scene);
  const double sinT = std::sqrt(0.75) / 1.5, tanT = sinT / std::sqrt(1 - sinT * sinT);
  const double shift = 0.02 * (std::sqrt(3.0) - tanT);
  const auto place = [&](const PhotonHit& h) -> std::size_t {
    if (h.hit.material != 0) return 2;
    const Vec3d p = scene.frame.toWorld(h.hit.position);
    if (length(p) < 0.45 * shift) return 0;
    return length(p - Vec3d{-shift, 0, 0}) < 0.45 * shift ? 1 : 2;
  };
  FluxMeter meter(2, place);
  test::expectBalance(test::fly(photons, 100'000, meter));
  return {meter[0], meter[1]};
}

TEST(GlassTransport, AThinPaneTransmitsWithoutShiftAndASolidOneShifts) {
  const double f = fresnel(0.5, 1.5);
  const PaneResult thin = beamThrough(test::glassMaterial(false, 0), false);
  test::expectMean(thin.straight, 1 - f, 3, 2e-3);
  EXPECT_LT(thin.shifted.mean(), 2e-3);
  const PaneResult solid = beamThrough(clearGlass(), true);
  test::expectMean(solid.shifted, (1 - f) * (1 - f), 3, 5e-3);  // light reflected twice lands farther on
  EXPECT_LT(solid.straight.mean(), 0.01);
}

// A ball lens: rays near the axis meet at n·R / (2(n − 1)) from its centre, 1.5 R for n = 1.5.
TEST(GlassTransport, ASphereFocusesTheSunBehindIt) {
  const auto axisFlux = [](bool withSphere) {
    SceneBuilder b;
    test::addPlate(b, 0, 1, b.addMaterial(black()));
    const auto glass = b.addMaterial(clearGlass());
    if (withSphere) test::addSphere(b, {0, 0.6, 0}, 0.4, glass, 24);
    b.addLight(test::sunLight({0, -1, 0}, Rgb(1000.f)));
    Scene scene = b.build();
    if (withSphere) test::smoothen(scene, glass, {0, 0.6, 0});
    const PhotonScene photons(scene);
    const auto place = [&](const PhotonHit& h) -> std::size_t {
      const Vec3d p = scene.frame.toWorld(h.hit.position);
      return h.hit.material != 0 ? 2 : length(p) < 0.05 ? 0 : length(p) < 0.4 ? 1 : 2;
    };
    FluxMeter meter(2, place);
    const Ledger l = test::fly(photons, 300'000, meter);
    test::expectBalance(l);
    return std::pair(meter[0].mean() * photons.emitters().totalFlux(),
                     meter[1].mean() * photons.emitters().totalFlux());
  };
  const auto [plainAxis, plainShadow] = axisFlux(false);
  EXPECT_NEAR(plainAxis, 1000 * kPi64 * 0.05 * 0.05, 0.1 * plainAxis);
  const auto [axis, shadow] = axisFlux(true);
  EXPECT_GT(axis, 10 * plainAxis);
  EXPECT_LT(shadow, 0.5 * plainShadow);
  EXPECT_LT(axis + shadow, plainAxis + plainShadow) << "no more than falls on the sphere";
}

}  // namespace
}  // namespace lucarne::glass_transport_test
