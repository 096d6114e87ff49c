#include "tracer/optics/glass_table.h"

#include <gtest/gtest.h>

#include "tests/support/statistics.h"
#include "tests/tracer/glass_cases.h"
#include "tracer/optics/ggx.h"
#include "tracer/optics/glass_albedo.h"

namespace lucarne::glass_table_test {
namespace {

using test::atCosine;
using test::GlassCase;
using test::glassRandoms;
using test::Mean;

constexpr double kTableError = 1e-3;

TEST(GlassTable, AlbedoIsTheMeanWeightWithinStandardErrors) {
  const auto cases = test::glassCases({0.001f, 0.03f, 0.3f, 1.f});
  const std::vector<Vec3f> directions{atCosine(1), atCosine(0.75f), atCosine(0.4f), atCosine(0.05f)};
  const double z = test::zThreshold(3 * cases.size() * directions.size());
  for (const GlassCase& c : cases) {
    const GlassTable table(c.ior, c.thin, c.alpha);
    for (const Vec3f wi : directions) {
      Mean channel[3];
      for (std::uint64_t i = 0; i < 40000; ++i) {
        const auto s = sample(c.glass(), wi, glassRandoms(20, i), Transport::flux);
        for (int k = 0; k < 3; ++k) channel[k].add(s ? static_cast<double>(s->weight[k]) : 0);
      }
      const Rgb a = albedo(c.glass(), table, wi, c.inside);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(static_cast<double>(a[k]), channel[k].mean(), z * channel[k].error() + kTableError)
            << c.name() << " cos " << wi.z;
    }
  }
}

double difference(const GlassTable::Albedo& a, Vec3f b) {
  return static_cast<double>(
      std::max(std::abs(a.reflected - b.x), std::max(std::abs(a.totalInternal - b.y), std::abs(a.transmitted - b.z))));
}

/// Half of the cosines lie about the critical angle or grazing, as near as the lobe is wide.
float cosineNearFeatures(Vec3f u, float eta, float alpha) {
  const float critical = eta < 1 ? std::sqrt(1 - eta * eta) : 0.f;
  return std::clamp(u.z < 0.5f ? u.x : critical + (u.x - 0.5f) * 10 * alpha, 1e-3f, 1.f);
}

TEST(GlassTable, InterpolatesWithinItsStatedError) {
  const GaussRule fine(40);
  for (const auto& [ior, thin] : std::vector<std::pair<float, bool>>{{1.5f, false}, {1.5f, true}, {2.4f, false}}) {
    const GlassTable table(ior, thin);
    for (const bool inside : {false, true}) {
      if (thin && inside) continue;
      const float eta = inside ? 1 / ior : ior;
      double sum = 0;
      constexpr int questions = 200;
      for (std::uint64_t i = 0; i < questions; ++i) {
        const Vec3f u = glassRandoms(21, i);
        const float root = 0.4217f + 0.5783f * u.y, alpha = std::max(std::pow(root, 8.f), kMinAlpha);
        const float c = cosineNearFeatures(u, eta, alpha);
        const double d = difference(table.at(c, alpha, inside), glassShares(eta, thin, alpha, c, fine));
        EXPECT_LT(d, kTableError) << ior << " inside " << inside << " alpha " << alpha << " cos " << c;
        sum += d;
      }
      EXPECT_LT(sum / questions, 2e-4);
    }
  }
}

TEST(GlassTable, OneRoughnessAloneIsFiner) {
  const GaussRule fine(40);
  for (const float alpha : {kMinAlpha, 0.03f, 0.5f})
    for (const bool inside : {false, true}) {
      const GlassTable table(1.5f, false, alpha);
      const float eta = inside ? 1 / 1.5f : 1.5f;
      for (std::uint64_t i = 0; i < 100; ++i) {
        const float c = cosineNearFeatures(glassRandoms(22, i), eta, alpha);
        EXPECT_LT(difference(table.at(c, alpha, inside), glassShares(eta, false, alpha, c, fine)), 5e-4)
            << "inside " << inside << " alpha " << alpha << " cos " << c;
      }
    }
}

TEST(GlassTable, ClearGlassLosesNothingWhileSmoothAndNeverGains) {
  for (const auto& [ior, thin] : std::vector<std::pair<float, bool>>{
           {1.f, false}, {1.05f, false}, {1.5f, false}, {1.5f, true}, {2.4f, false}, {0.f, false}}) {
    const GlassTable table(ior, thin);
    for (const bool inside : {false, true})
      for (const float alpha : {0.001f, 0.004f, 0.1f, 0.4f, 1.f})
        for (const float c : {0.f, 1e-4f, 0.01f, 0.05f, 0.3f, 0.74535f, 0.9f, 1.f}) {
          const float sum = table.at(c, alpha, inside).sum();
          EXPECT_LE(sum, 1 + 1e-6f) << ior << " " << alpha << " " << c;
          EXPECT_GT(sum, 0.02f) << ior << " " << alpha << " " << c;
          if (alpha <= 0.004f && c >= 0.05f) {
            EXPECT_GE(sum, 0.98f) << ior << " " << alpha << " " << c;
          }
        }
  }
}

TEST(GlassTable, InfiniteIndexReflectsAndNoDifferenceTransmits) {
  const GlassTable mirror(0, false), air(1, false);
  for (const bool inside : {false, true}) {
    const auto m = mirror.at(0.6f, 0.01f, inside), a = air.at(0.6f, 0.7f, inside);
    EXPECT_NEAR(m.reflected, 1, 1e-3f);
    EXPECT_EQ(m.transmitted + m.totalInternal, 0);
    EXPECT_NEAR(a.transmitted, 1, 1e-4f);
    EXPECT_NEAR(a.reflected + a.totalInternal, 0, 1e-9f);
  }
}

}  // namespace
}  // namespace lucarne::glass_table_test
