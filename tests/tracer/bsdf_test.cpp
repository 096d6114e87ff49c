#include "tracer/optics/bsdf.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tests/support/statistics.h"
#include "tracer/optics/ggx.h"
#include "tracer/optics/phong.h"
#include "tracer/optics/sampler.h"
#include "tracer/optics/surface.h"

namespace lucarne::bsdf_test {
namespace {

constexpr int kCos = 20, kAzimuth = 40;

Bsdf glossy(float alpha, Rgb diffuse, float f0) {
  Bsdf b;
  b.diffuse = diffuse;
  b.f0 = Rgb(f0);
  b.f90 = Rgb(1.f);
  b.alpha = alpha;
  return b;
}

std::vector<Bsdf> bsdfs() {
  Bsdf lambert;
  lambert.diffuse = {0.8f, 0.5f, 0.2f};
  return {lambert, glossy(1.f, Rgb(0.f), 0.9f), glossy(0.4f, Rgb(0.5f), 0.04f),
          glossy(alphaFromPhong(10), {0.3f, 0.2f, 0.1f}, 0.2f), glossy(0.1f, Rgb(0.7f), 0.5f)};
}

std::vector<Vec3f> directions() {
  return {
      {0, 0, 1}, normalize(Vec3f{0.5f, 0.2f, 0.8f}), normalize(Vec3f{-0.9f, 0.1f, 0.3f}), normalize(Vec3f{1, 1, 0.1f})};
}

std::size_t binOf(Vec3f w) {
  const double phi = std::atan2(w.y, w.x) / (2 * std::numbers::pi) + 0.5;
  const auto i = std::min<std::size_t>(kCos - 1, static_cast<std::size_t>(w.z * kCos));
  return i * kAzimuth + std::min<std::size_t>(kAzimuth - 1, static_cast<std::size_t>(phi * kAzimuth));
}

Vec3f sphereDirection(double z, double turns) {
  const double r = std::sqrt(std::max(0.0, 1 - z * z)), phi = (turns - 0.5) * 2 * std::numbers::pi;
  return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)};
}

/// ∫ f over each bin of the upper hemisphere, by a fine midpoint rule.
template <class F>
std::vector<double> integrateBins(F&& density) {
  constexpr int sub = 24;
  std::vector<double> bins(kCos * kAzimuth, 0);
  const double cell = 2 * std::numbers::pi / (kCos * kAzimuth * sub * sub);
  for (int i = 0; i < kCos * sub; ++i)
    for (int j = 0; j < kAzimuth * sub; ++j) {
      const Vec3f w = sphereDirection((i + 0.5) / (kCos * sub), (j + 0.5) / (kAzimuth * sub));
      bins[static_cast<std::size_t>(i / sub * kAzimuth + j / sub)] += density(w) * cell;
    }
  return bins;
}

double samplerP(const Bsdf& b, Vec3f wi, double pdfPower) {
  constexpr int samples = 100000;
  std::vector<double> observed(kCos * kAzimuth, 0);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const auto u = PhotonSampler(3, i).floats(1, Stream::scatter);
    if (const auto s = sample(b, wi, {u[0], u[1], u[2]})) ++observed[binOf(s->wo)];
  }
  auto expected = integrateBins([&](Vec3f w) { return std::pow(static_cast<double>(pdf(b, wi, w)), pdfPower); });
  for (double& e : expected) e *= samples;
  return test::chiSquareP(observed, expected);
}

TEST(Bsdf, SamplesFollowTheirDensity) {
  const double significance = 1e-4 / static_cast<double>(bsdfs().size() * directions().size());
  for (std::size_t k = 0; k < bsdfs().size(); ++k)
    for (const Vec3f wi : directions())
      EXPECT_GT(samplerP(bsdfs()[k], wi, 1), significance) << "bsdf " << k << " cos " << wi.z;
}

// The test of the tester.
TEST(Bsdf, AWrongDensityIsRejected) { EXPECT_LT(samplerP(bsdfs()[2], directions()[1], 1.1), 1e-10); }

TEST(Bsdf, TheSampledDensityIsTheReportedOne) {
  for (const Bsdf& b : bsdfs())
    for (std::uint64_t i = 0; i < 1000; ++i) {
      const auto u = PhotonSampler(4, i).floats(1, Stream::scatter);
      const auto s = sample(b, directions()[1], {u[0], u[1], u[2]});
      if (s) {
        EXPECT_NEAR(s->pdf, pdf(b, directions()[1], s->wo), 1e-4f * s->pdf);
      }
    }
}

TEST(Bsdf, IsReciprocal) {
  for (const Bsdf& b : bsdfs())
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const auto u = PhotonSampler(5, i).floats(1, Stream::scatter);
      const Vec3f a = sphereDirection(0.01 + 0.99 * static_cast<double>(u[0]), static_cast<double>(u[1]));
      const Vec3f c = sphereDirection(0.01 + 0.99 * static_cast<double>(u[2]), static_cast<double>(u[3]));
      const Rgb f = evaluate(b, a, c), g = evaluate(b, c, a);
      EXPECT_NEAR(f.y, g.y, 2e-3f * std::max(f.y, 1e-3f));
    }
}

TEST(Bsdf, AlbedoIsTheMeanWeightWithinStandardErrors) {
  constexpr int samples = 400000;
  const double z = test::zThreshold(bsdfs().size() * directions().size());
  for (std::size_t k = 1; k < bsdfs().size(); ++k)
    for (const Vec3f wi : directions()) {
      const Bsdf b = bsdfs()[k];
      double sum = 0, squares = 0;
      for (std::uint64_t i = 0; i < samples; ++i) {
        const auto u = PhotonSampler(6, i).floats(1, Stream::scatter);
        const auto s = sample(b, wi, {u[0], u[1], u[2]});
        const double w = s ? static_cast<double>(s->weight.y) : 0;
        sum += w;
        squares += w * w;
      }
      const double m = sum / samples, se = std::sqrt((squares / samples - m * m) / samples);
      constexpr double tableError = 5e-4;  // of the tabulated coat albedo (specular_table.cpp)
      EXPECT_NEAR(m, static_cast<double>(albedo(b, wi).y), z * se + tableError) << "bsdf " << k << " cos " << wi.z;
    }
}

TEST(Bsdf, NeverReflectsMoreThanItReceives) {
  for (const float f0 : {0.f, 0.04f, 0.5f, 1.f})
    for (const float alpha : {0.001f, 0.05f, 0.3f, 1.f})
      for (const float c : {0.001f, 0.1f, 0.5f, 1.f})
        EXPECT_LE(maxComponent(albedo(glossy(alpha, Rgb(1.f), f0), {std::sqrt(1 - c * c), 0, c})), 1.0f + 1e-4f);
}

// The white furnace: whatever the roughness and the angle.
TEST(Bsdf, AWhiteMetalReflectsEverything) {
  for (const float alpha : {0.001f, 0.05f, alphaFromPhong(10), alphaFromPhong(1), 1.f})
    for (const float c : {0.05f, 0.3f, 0.7f, 1.f})
      EXPECT_NEAR(albedo(glossy(alpha, Rgb(0.f), 1.f), {std::sqrt(1 - c * c), 0, c}).y, 1.f, 1e-5f)
          << alpha << " " << c;
}

TEST(Bsdf, DielectricWithSpecularZeroIsExactlyLambert) {
  Material m;
  m.metallic = 0;
  m.specular = 0;
  m.roughness = 0.3f;
  m.baseColor = Rgb(0.6f);
  const Bsdf b = makeBsdf(m, factorsOf(m));
  EXPECT_TRUE(b.lambert());
  EXPECT_EQ(albedo(b, directions()[2]), Rgb(0.6f));
}

TEST(Phong, ExponentAndRoughnessAreInverse) {
  for (const float n : {0.5f, 1.f, 10.f, 100.f, 1000.f}) {
    EXPECT_NEAR(phongFromAlpha(alphaFromPhong(n)), n, 1e-4f * n);
    EXPECT_NEAR(roughnessFromPhong(n) * roughnessFromPhong(n), alphaFromPhong(n), 1e-6f);
  }
  EXPECT_NEAR(alphaFromPhong(10), 0.2182f, 1e-4f);
}

}  // namespace
}  // namespace lucarne::bsdf_test
