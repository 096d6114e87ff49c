// Bakes of geometry and lights that are easily mistaken: degenerate, doubled, touching, sealed, on edge.
#include <gtest/gtest.h>

#include "tests/app/deviation.h"

namespace lucarne::extremes_geometry_test {
namespace {

using test::BakedScene;
using test::deviationFrom;
using test::fraction;
using test::kPi64;
using test::ProbedBake;
using test::SceneBuilder;

Light pointLight(Vec3d position, float intensity = 100) {
  Light l;
  l.position = position;
  l.intensity = Rgb(intensity);
  return l;
}

std::uint32_t addDoubleSided(SceneBuilder& s, float albedo, float emission = 0) {
  Material m = test::diffuseMaterial(Rgb(albedo), Rgb(emission));
  m.doubleSided = true;
  return s.addMaterial(m);
}

/// |z| of a share p of n photons that came to `share`.
double zOfShare(double share, double p, std::uint64_t n) {
  return std::abs(share - p) / std::sqrt(p * (1 - p) / static_cast<double>(n));
}

TEST(DegenerateTriangles, ChangeNothing) {
  SceneBuilder s;
  const auto wall = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  s.addBox({0, 0, 0}, {2, 1.25, 1.75}, wall, true);
  const BakedScene clean(s.build(), test::quickOptions(50'000, 8));
  s.addTriangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, wall);              // a point
  s.addTriangle({0, 0.5, 0.5}, {1, 0.5, 0.5}, {2, 0.5, 0.5}, wall);  // a line through the room
  s.addTriangle({0, 0, 0}, {2, 0, 0}, {0, 0, 0}, wall);              // an edge of the room
  s.addTriangle({0.5, 0, 0.5}, {1, 0, 1}, {1.5, 0, 1.5}, wall);      // a line on the floor
  s.addTriangle({1, 1, 1}, {1 + 1e-20, 1, 1}, {1, 1 + 1e-20, 1}, wall);
  const BakedScene b(s.build(), test::quickOptions(50'000, 8));
  EXPECT_EQ(b.baked.contentHash, clean.baked.contentHash);
  EXPECT_EQ(b.baked.emittedFlux, clean.baked.emittedFlux);
}

TEST(Slivers, DoNotDisturbTheFurnaceTheyAreIn) {
  SceneBuilder s;
  const auto wall = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  s.addBox({0, 0, 0}, {2, 1.25, 1.75}, wall, true);
  for (int i = 0; i < 20; ++i) {
    const double y = 0.05 + 0.06 * i, thin = std::pow(10, -3 - 0.3 * i);
    s.addTriangle({0.1, y, 0.3}, {1.9, y, 1.4}, {1, y + thin, 0.85}, wall);
    s.addTriangle({0.1, y, 0.3}, {1, y + thin, 0.85}, {1.9, y, 1.4}, wall);  // its back
  }
  const BakedScene b(s.build(), test::quickOptions(500'000, 8));
  double worst = 0;
  std::uint64_t texels = 0;
  forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double) {
    if (b.baked.maps.photons[t] < 25) return;  // texels of slivers hold next to no surface
    const double e = static_cast<double>(b.baked.maps.irradiance[t].y);
    const double se = static_cast<double>(b.baked.maps.relativeError[t]) * std::sqrt(e * kPi64 * 200);
    worst = std::max(worst, std::abs(e - kPi64 * 200) / se);
    ++texels;
  });
  EXPECT_GT(texels, 900u);
  EXPECT_LT(worst, test::zThreshold(texels));
  EXPECT_EQ(b.baked.ledger.strayValues, 0u);
  EXPECT_TRUE(b.baked.ledger.balance() == b.baked.ledger.emitted);
  EXPECT_TRUE(b.baked.ledger.escaped == FluxSum{});
}

TEST(CoincidentTriangles, ShareTheLightOfOne) {
  SceneBuilder s;
  const auto black = s.addDiffuse(Rgb(0.f));
  for (int copy = 0; copy < 3; ++copy) s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, black);
  s.addLight(pointLight({0, 1, 0}));
  const BakedScene b(s.build(), test::quickOptions(200'000, 1e-3));
  double flux = 0;
  for (const SideMaps& side : b.baked.maps.sides) flux += 4 * meanIrradiance(b, side).y;
  const double p = test::solidAngleFromMiddle(2, 2, 1) / (4 * kPi64);
  EXPECT_LT(zOfShare(flux / (400 * kPi64), p, 200'000), test::zThreshold(1));
  EXPECT_EQ(b.baked.ledger.storedHits, b.baked.ledger.hits);
}

TEST(CoincidentTriangles, BackToBackWallsOfTwoRoomsAreEachLitByTheirOwn) {
  // Every wall has the other room's, or the outside's, on its very plane.
  for (const bool outside : {false, true}) {
    SceneBuilder s;
    const auto wall = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
    s.addBox({0, 0, 0}, {1, 1.1, 1.2}, wall, true);
    if (outside) {
      s.addBox({0, 0, 0}, {1, 1.1, 1.2}, s.addDiffuse(Rgb(0.3f)), false);
    } else {
      s.addBox({1, 0, 0}, {2.3, 1.1, 1.2}, wall, true);
    }
    const BakedScene b(s.build(), test::quickOptions(500'000, 6));
    const test::Deviation d = deviationFrom(b, kPi64 * 200);
    EXPECT_GT(d.texels, outside ? 250u : 500u);
    EXPECT_LT(d.worst, test::zThreshold(d.texels)) << (outside ? "inside and outside" : "two rooms");
    EXPECT_LT(d.ofMean, 4);
  }
}

TEST(SealedSolid, WithALightInsideLeavesTheRoomBlack) {
  for (const bool doubleSided : {false, true}) {
    SceneBuilder s;
    s.addBox({0, 0, 0}, {4, 3, 4}, s.addDiffuse(Rgb(0.8f)), true);
    // Small, and off the grid of single precision: many photons come near its edges.
    const auto shell = doubleSided ? addDoubleSided(s, 0.9f) : s.addDiffuse(Rgb(0.9f));
    s.addBox({1.1, 1.1, 1.1}, {1.13, 1.14, 1.12}, shell, false);
    s.addLight(pointLight({1.11, 1.12, 1.115}));
    const BakedScene b(s.build(), test::quickOptions(500'000, 4));
    for (const SideMaps& side : b.baked.maps.sides) {
      if (b.baked.maps.charts[side.chart].material == shell && side.back) {
        EXPECT_TRUE(side.lit);
      } else {
        EXPECT_FALSE(side.lit) << "chart " << side.chart << ": " << photonsOf(b, side) << " photons";
      }
    }
    EXPECT_TRUE(b.baked.ledger.escaped == FluxSum{});
  }
}

TEST(SealedRoom, WithSharpEdgesLosesNoPhoton) {
  SceneBuilder s;
  const auto wall = s.addDiffuse(Rgb(0.9f), Rgb(100.f));
  const Vec3d a{0, 0, 0}, b{1, 0.1, 0.2}, c{0.2, 1.1, 0.1}, d{0.3, 0.2, 0.9};
  s.addTriangle(a, b, c, wall);
  s.addTriangle(a, d, b, wall);
  s.addTriangle(b, d, c, wall);
  s.addTriangle(c, d, a, wall);
  const BakedScene room(s.build(), test::quickOptions(1'000'000, 4));
  EXPECT_TRUE(room.baked.ledger.escaped == FluxSum{}) << fraction(room.baked.ledger.escaped.units[1]) << " photons";
}

/// A lamp that touches a one-sided wall is in front of it; one that touches a two-sided wall shines to both sides.
TEST(PointLight, ExactlyOnAWallLightsTheRoomInFrontOfIt) {
  for (const double height : {2.0, 2.1, 2.2}) {  // on the grid of single precision and off it
    for (const bool doubleSided : {false, true}) {
      for (const bool inward : {true, false}) {
        if (!inward && !doubleSided) continue;
        SceneBuilder s;
        s.addBox({-1, 0, -1}, {1, height, 1}, doubleSided ? addDoubleSided(s, 0) : s.addDiffuse(Rgb(0.f)), inward);
        s.addLight(pointLight({0, height, 0}));
        const BakedScene b(s.build(), test::quickOptions(200'000, 1e-3));
        double floor = 0;  // lx, on the one chart and side that faces up
        for (const SideMaps& side : b.baked.maps.sides)
          if (b.baked.maps.charts[side.chart].normal.y * (side.back ? -1.f : 1.f) > 0.99f && side.lit)
            floor += meanIrradiance(b, side).y;
        const double p = test::solidAngleFromMiddle(2, 2, height) / (4 * kPi64);
        EXPECT_LT(zOfShare(4 * floor / (400 * kPi64), p, 200'000), test::zThreshold(9))
            << height << (doubleSided ? " double-sided" : "") << (inward ? " inward" : " outward");
      }
    }
  }
}

TEST(Plate, KeepsItsBrightAndItsDarkSideApart) {
  SceneBuilder s;
  const auto wall = s.addDiffuse(Rgb(0.9f));
  const auto plate = addDoubleSided(s, 0.9f);
  s.addBox({0, 0, 0}, {2.2, 1.1, 1.3}, wall, true);
  s.addQuad({1.1, 0, 0}, {1.1, 0, 1.3}, {1.1, 1.1, 1.3}, {1.1, 1.1, 0}, plate);  // its front toward −x
  s.addLight(pointLight({0.4, 0.7, 0.3}));
  const BakedScene b(s.build(), test::quickOptions(500'000, 16));
  const ProbedBake probe(b, "plate");
  for (double y = 0.05; y < 1.1; y += 0.1) {
    for (double z = 0.05; z < 1.3; z += 0.1) {
      EXPECT_GT(probe.at({1.1, y, z}, {-1, 0, 0}).irradiance.y, 0);
      const ProbeAnswer dark = probe.at({1.1, y, z}, {1, 0, 0}), far = probe.at({2.2, y, z}, {-1, 0, 0});
      ASSERT_TRUE(dark.onSurface && far.onSurface);
      EXPECT_EQ(dark.irradiance, Rgbd{});
      EXPECT_EQ(far.irradiance, Rgbd{});
    }
  }
}

TEST(ThinWall, OfAMillimetreKeepsASealedRoomDark) {
  SceneBuilder s;
  const auto wall = addDoubleSided(s, 0.9f);
  s.addBox({0, 0, 0}, {4, 2.5, 3}, wall, true);
  s.addBox({4.001, 0, 0}, {8, 2.5, 3}, wall, true);
  s.addLight(pointLight({2, 1, 1}));
  const BakedScene b(s.build(), test::quickOptions(300'000, 8));
  const ProbedBake probe(b, "thin_wall");
  for (double y = 0.06; y < 2.5; y += 0.12) {
    for (double z = 0.06; z < 3; z += 0.12) {
      const ProbeAnswer bright = probe.at({4, y, z}, {-1, 0, 0}), dark = probe.at({4.001, y, z}, {1, 0, 0});
      ASSERT_TRUE(bright.onSurface && dark.onSurface);
      EXPECT_GT(bright.irradiance.y, 0);
      EXPECT_EQ(dark.irradiance, Rgbd{});
    }
  }
}

TEST(SpotLight, WithEqualConesHasASharpEdge) {
  SceneBuilder s;
  s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, s.addDiffuse(Rgb(0.f)));
  Light l = pointLight({0.05, 1, -0.1}, 300);
  l.kind = LightKind::spot;
  l.direction = {0, -1, 0};
  l.cosInner = l.cosOuter = 0.8;  // a circle of 0.75 m
  s.addLight(l);
  const BakedScene b(s.build(), test::quickOptions(1'000'000, 16));
  const ProbedBake probe(b, "spot");
  EXPECT_NEAR(b.baked.emittedFlux, 2 * kPi64 * 0.2 * 300, 1e-4);
  EXPECT_TRUE(b.baked.ledger.absorbed == b.baked.ledger.emitted);
  double worst = 0;
  constexpr double kReach = 2.5 / 16;  // of the kernel and of bilinear lookup, by both axes
  for (double x = -0.95; x < 1; x += 0.1) {
    for (double z = -0.95; z < 1; z += 0.1) {
      const double r = std::hypot(x - l.position.x, z - l.position.z), d2 = r * r + 1;
      const ProbeAnswer a = probe.at({x, 0, z}, {0, 1, 0});
      if (r > 0.75 + kReach * std::sqrt(2)) {
        EXPECT_EQ(a.irradiance, Rgbd{});
      }
      if (r >= 0.75 - kReach * std::sqrt(2)) continue;
      // The kernel and bilinear lookup average over about a texel and a half: up to h²/2·E″, E″/E ≤ 3/d².
      const double bias = 0.5 * std::pow(1.5 / 16, 2) * 3 / d2;
      worst = std::max(worst, (std::abs(a.irradiance.y * std::pow(d2, 1.5) / 300 - 1) - bias) / a.relativeError);
    }
  }
  EXPECT_LT(worst, test::zThreshold(400));
}

TEST(DirectionalLight, OverAPlaneReadsItsLuxTimesTheCosineAndTheRestEscapes) {
  SceneBuilder s;
  s.addQuad({-1, 0, 2}, {1, 0, 2}, {1, 0, -2}, {-1, 0, -2}, s.addDiffuse(Rgb(0.f)));
  Light l;
  l.kind = LightKind::directional;
  l.direction = normalize(Vec3d{0.3, -1, 0.2});
  l.intensity = Rgb(1000.f);
  s.addLight(l);
  BakeOptions options = test::quickOptions(1'000'000, 8);
  options.guidedEmission = false;  // every photon weighs 1
  const BakedScene b(s.build(), options);
  const double expected = 1000 * -l.direction.y;
  const test::Deviation d = deviationFrom(b, expected);
  EXPECT_EQ(d.texels, 16u * 32u);
  EXPECT_LT(d.worst, test::zThreshold(d.texels));
  // Emitted through the disc about the scene's bounding sphere; the plane takes E·A of it.
  EXPECT_NEAR(b.baked.emittedFlux / (kPi64 * 5 * 1000), 1, 3e-4);
  const double share = expected * 8 / b.baked.emittedFlux;
  const FluxSum& escaped = b.baked.ledger.escaped;
  EXPECT_LT(zOfShare(1 - fraction(escaped.units[1]) / 1e6, share, 1'000'000), test::zThreshold(1));
  EXPECT_TRUE(b.baked.ledger.balance() == b.baked.ledger.emitted);
  EXPECT_EQ(b.baked.ledger.rays - b.baked.ledger.hits, static_cast<std::uint64_t>(escaped.units[1] >> kFixedPointBits));
}

TEST(DirectionalLight, AlongAPlaneAndFromBehindItReadsNothing) {
  for (const Vec3d direction : {Vec3d{1, 0, 0}, Vec3d{0.6, 0.8, 0}}) {
    SceneBuilder s;
    s.addQuad({-1, 0, 2}, {1, 0, 2}, {1, 0, -2}, {-1, 0, -2}, s.addDiffuse(Rgb(0.5f)));
    Light l;
    l.kind = LightKind::directional;
    l.direction = direction;
    s.addLight(l);
    const BakedScene b(s.build(), test::quickOptions(100'000, 8));
    EXPECT_FALSE(b.baked.maps.sides.at(0).lit);
    EXPECT_TRUE(b.baked.ledger.balance() == b.baked.ledger.emitted);
  }
}

TEST(ColouredLight, KeepsTheRatiosOfItsChannels) {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {2, 1.3, 1.7}, s.addDiffuse(Rgb(0.5f)), true);
  Light l = pointLight({0.7, 0.9, 0.5});
  l.intensity = {900.f, 70.f, 5.f};
  s.addLight(l);
  const BakedScene b(s.build(), test::quickOptions(200'000, 8));
  // Each deposit rounds to 2^-24 of the flux, blue ones are 5·3/975 of it; floats round to 2^-24 of themselves.
  forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double) {
    const Rgbd e(b.baked.maps.irradiance[t]);
    EXPECT_NEAR(e.y / e.x * 900 / 70, 1, 1e-6);
    EXPECT_NEAR(e.z / e.x * 900 / 5, 1, 5e-6);
  });
}

}  // namespace
}  // namespace lucarne::extremes_geometry_test
