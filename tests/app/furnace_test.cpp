// Closed forms: scenes whose light maps are known on paper.
#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tests/app/deviation.h"

namespace lucarne::furnace_test {
namespace {

using test::BakedScene;
using test::Deviation;
using test::deviationFrom;
using test::kPi64;
using test::ProbedBake;
using test::SceneBuilder;

class Furnace : public testing::TestWithParam<double> {};

TEST_P(Furnace, EveryTexelReadsPiLeOverOneMinusAlbedo) {
  const double albedo = GetParam(), le = 100;
  SceneBuilder s;
  s.addBox({0, 0, 0}, {2, 1.3, 1.7}, s.addDiffuse(Rgb(static_cast<float>(albedo)), Rgb(static_cast<float>(le))), true);
  const BakedScene b(s.build(), test::quickOptions(3'000'000, 16));
  const Deviation d = deviationFrom(b, kPi64 * le / (1 - albedo));
  EXPECT_GT(d.texels, 3000u);
  EXPECT_LT(d.worst, test::zThreshold(d.texels)) << d.texels << " texels";
  EXPECT_LT(d.ofMean, 4);
}
INSTANTIATE_TEST_SUITE_P(Albedo, Furnace, testing::Values(0.0, 0.5, 0.9));

// The test of the tester: two percent too much light must be seen.
TEST(FurnaceTester, SeesTwoPercent) {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {2, 1.3, 1.7}, s.addDiffuse(Rgb(0.5f), Rgb(102.f)), true);
  const BakedScene b(s.build(), test::quickOptions(3'000'000, 16));
  EXPECT_GT(deviationFrom(b, kPi64 * 100 / 0.5).ofMean, 10);
}

TEST(GlossyFurnace, ConstantLightStaysConstantUnderGlossyWalls) {
  SceneBuilder s;
  Material m = test::diffuseMaterial(Rgb(0.4f), Rgb(100.f));
  m.specular = 1;
  m.roughness = 0.4671f;
  s.addBox({0, 0, 0}, {2, 1.3, 1.7}, s.addMaterial(m), true);
  const BakedScene b(s.build(), test::quickOptions(3'000'000, 8));
  // Glossy walls absorb by direction, but in a furnace every direction carries the same radiance: what the wall emits
  // plus its albedo for light from everywhere. The mean albedo follows from the ledger.
  const double absorbed = static_cast<double>(b.baked.ledger.expectedAbsorbed.units[1]);
  const double incident = static_cast<double>(b.baked.ledger.incident.units[1]);
  const Deviation d = deviationFrom(b, kPi64 * 100 / (absorbed / incident));
  // GGX loses light at grazing angles, so radiance is not exactly constant there: bounded, not exact.
  EXPECT_LT(d.ofMean, 10);
}

TEST(PointLight, OverAPlaneReadsIntensityCosineOverSquareDistance) {
  SceneBuilder s;
  s.addQuad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, s.addDiffuse(Rgb(0.f)));
  Light l;
  l.position = {0.3, 1.5, -0.2};
  l.intensity = Rgb(800.f);
  s.addLight(l);
  const BakedScene b(s.build(), test::quickOptions(6'000'000, 10));
  const ProbedBake probe(b, "point_light");
  double worst = 0;
  int questions = 0;
  // Off the border, where kernels are cut and so lean inward.
  for (double x = -1.7; x < 1.8; x += 0.2)
    for (double z = -1.7; z < 1.8; z += 0.2) {
      const Vec3d p{x, 0, z}, d = l.position - p;
      const double expected = 800 * l.position.y / std::pow(length(d), 3);
      const ProbeAnswer a = probe.at(p, {0, 1, 0});
      ASSERT_TRUE(a.onSurface);
      // The kernel averages over 1.5 texels, the map is linear between texels: bias up to h²/2·E″ with E″/E ≤ 3/d².
      const double bias = 0.5 * 0.15 * 0.15 * 3 / dot(d, d);
      worst = std::max(worst, (std::abs(a.irradiance.y / expected - 1) - bias) / a.relativeError);
      ++questions;
    }
  EXPECT_EQ(questions, 324);
  EXPECT_LT(worst, test::zThreshold(324));
}

/// Irradiance below a corner of a horizontal rectangle a × b at height h, of radiance 1: the configuration factor of a
/// differential element to a parallel rectangle, times π (Howell, catalogue of configuration factors, B-4).
double cornerIrradiance(double a, double b, double h) {
  const double x = a / h, y = b / h, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return 0.5 * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
}

/// Of a rectangle [x0,x1] × [z0,z1], with signed corners.
double rectangleIrradiance(double x0, double x1, double z0, double z1, double h) {
  const auto f = [&](double x, double z) {
    return std::copysign(1.0, x) * std::copysign(1.0, z) * cornerIrradiance(std::abs(x), std::abs(z), h);
  };
  return f(x1, z1) - f(x0, z1) - f(x1, z0) + f(x0, z0);
}

TEST(RectangleLight, ReadsTheFormFactorIntegral) {
  SceneBuilder s;
  s.addQuad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, s.addDiffuse(Rgb(0.f)));
  const auto lamp = s.addDiffuse(Rgb(0.f), Rgb(500.f));
  s.addQuad({-0.5, 1.2, -0.4}, {0.7, 1.2, -0.4}, {0.7, 1.2, 0.5}, {-0.5, 1.2, 0.5}, lamp);
  const BakedScene b(s.build(), test::quickOptions(6'000'000, 10));
  const ProbedBake probe(b, "rectangle_light");
  double worst = 0;
  for (double x = -1.9; x < 2; x += 0.2)
    for (double z = -1.9; z < 2; z += 0.2) {
      const double expected = 500 * rectangleIrradiance(-0.5 - x, 0.7 - x, -0.4 - z, 0.5 - z, 1.2);
      const ProbeAnswer a = probe.at({x, 0, z}, {0, 1, 0});
      worst =
          std::max(worst, (std::abs(a.irradiance.y / expected - 1) - 0.5 * 0.15 * 0.15 * 3 / 1.44) / a.relativeError);
    }
  EXPECT_LT(worst, test::zThreshold(400));
}

TEST(SealedBox, InsideALitRoomReadsExactlyZero) {
  SceneBuilder s;
  Material both = test::diffuseMaterial(Rgb(0.8f));
  both.doubleSided = true;
  s.addBox({0, 0, 0}, {4, 3, 4}, s.addDiffuse(Rgb(0.8f), Rgb(50.f)), true);
  s.addBox({1, 1, 1}, {2, 2, 2}, s.addMaterial(both), false);
  const BakedScene b(s.build(), test::quickOptions(1'000'000, 16));
  const ProbedBake probe(b, "sealed_box");
  for (double x = 1.001; x < 2; x += 0.111)
    for (double y = 1.001; y < 2; y += 0.111) {
      const ProbeAnswer inside = probe.at({x, y, 1}, {0, 0, 1});
      ASSERT_TRUE(inside.onSurface);
      EXPECT_EQ(inside.irradiance, Rgbd{});
      EXPECT_GT(probe.at({x, y, 1}, {0, 0, -1}).irradiance.y, 0);
    }
}

}  // namespace
}  // namespace lucarne::furnace_test
