#include "dlm/probe.h"

#include <gtest/gtest.h>

#include <memory>

#include "dlm/probe_closest.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/dlm/dlm_file_fixture.h"

namespace lucarne::probe_test {
namespace {

using test::BakedScene;

constexpr double kTolerance = 1e-4;  // of values up to about 100: the atlas coordinates are floats

Rgb linearValue(int x, int y) {
  const float s = static_cast<float>(x) + 0.5f, t = static_cast<float>(y) + 0.5f;
  return {1 + s, 10 + 2 * t, s + t};
}

void expectLinear(const ProbeAnswer& answer, double s, double t, double factor = 1) {
  EXPECT_TRUE(answer.onSurface);
  EXPECT_NEAR(answer.irradiance.x, factor * (1 + s), kTolerance);
  EXPECT_NEAR(answer.irradiance.y, factor * (10 + 2 * t), kTolerance);
  EXPECT_NEAR(answer.irradiance.z, factor * (s + t), kTolerance);
}

// A floor of 4 m × 3 m in texels of 0.5 m, both sides lit, the back ten times as bright; far from the origin.
class FloorProbe : public ::testing::Test {
 protected:
  static constexpr double kX = 100, kY = 20, kZ = -300;

  FloorProbe() : scene_(14) {
    scene_.builder.addMaterial(test::doubleSidedMaterial());
    scene_.builder.addQuad({kX, kY, kZ}, {kX, kY, kZ + 3}, {kX + 4, kY, kZ + 3}, {kX + 4, kY, kZ}, 0);
    scene_.addChart(0, {0, 1, 0}, 8, 6, 3, 2, 0.5);
    scene_.addSide(false, linearValue);
    for (const int psi : {1, 4, 9}) {
      scene_.addDirection(psi, [=](int x, int y) { return linearValue(x, y) * static_cast<float>(psi); });
    }
    scene_.addEmptyDirection(12);
    scene_.addSide(true, [](int x, int y) { return linearValue(x, y) * 10; });
    scene_.setAtlas(16, 12);
    dlm_ = scene_.reread(folder_ / "floor.dlm");
    prober_ = std::make_unique<Prober>(dlm_);
  }

  /// Metres from the floor's corner; the normal is up unless told otherwise.
  ProbeAnswer at(double x, double z, double y = 0, Vec3d normal = {0, 1, 0}) const {
    return prober_->probe({kX + x, kY + y, kZ + z}, normal);
  }

  TempFolder folder_;
  BakedScene scene_;
  Dlm dlm_;
  std::unique_ptr<Prober> prober_;
};

TEST_F(FloorProbe, LinearLightIsReproducedBetweenTexelCentres) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(0.25, 3.75), v(0.25, 2.75);
  for (int i = 0; i < 500; ++i) {
    const double x = u(rng), z = v(rng);
    const ProbeAnswer answer = at(x, z);
    expectLinear(answer, 2 * x, 2 * z);
    EXPECT_EQ(answer.chart, 0u);
    EXPECT_FALSE(answer.back);
  }
}

TEST_F(FloorProbe, ValuesAreHeldFromTheOutermostCentresToEdgesAndCorners) {
  expectLinear(at(0, 0), 0.5, 0.5);
  expectLinear(at(4, 0), 7.5, 0.5);
  expectLinear(at(0, 3), 0.5, 5.5);
  expectLinear(at(4, 3), 7.5, 5.5);
  expectLinear(at(0, 1.25), 0.5, 2.5);
  expectLinear(at(2.25, 3), 4.5, 5.5);
}

TEST_F(FloorProbe, PointsBesideTheSurfaceGetItsNearestPoint) {
  expectLinear(at(2, 1.5, 0.49), 4, 3);
  expectLinear(at(2, 1.5, -0.49), 4, 3);
  expectLinear(at(-0.4, 1.25), 0.5, 2.5);
  expectLinear(at(4.3, 3.3), 7.5, 5.5);
}

TEST_F(FloorProbe, BeyondATexelThereIsNoAnswer) {
  EXPECT_FALSE(at(2, 1.5, 0.51).onSurface);
  EXPECT_FALSE(at(-0.51, 1.5).onSurface);
  EXPECT_FALSE(at(4.4, 3.4).onSurface);  // 0.57 m from the corner
  EXPECT_FALSE(at(1e9, 0).onSurface);
  EXPECT_FALSE(at(-1e300, 1e300).onSurface);
}

TEST_F(FloorProbe, TheNormalChoosesTheSide) {
  const ProbeAnswer back = at(2, 1.5, 0, {0, -1, 0});
  EXPECT_TRUE(back.back);
  expectLinear(back, 4, 3, 10);
  EXPECT_TRUE(back.directions.empty());
  expectLinear(at(2, 1.5, 0, {0, 1e-30, 0}), 4, 3);  // any length
  expectLinear(at(2, 1.5, 0, {0, 1e200, 0}), 4, 3);
  expectLinear(at(2, 1.5, 0, {0.85, 0.55, 0}), 4, 3);    // 57 degrees
  EXPECT_FALSE(at(2, 1.5, 0, {0.9, 0.5, 0}).onSurface);  // 61 degrees
  EXPECT_FALSE(at(2, 1.5, 0, {1, 0, 0}).onSurface);
}

TEST_F(FloorProbe, DirectionsSayWhereTheirLightComesFrom) {
  const ProbeAnswer answer = at(1, 2);
  ASSERT_EQ(answer.directions.size(), 4u);
  const DirectionSet set(14);
  const int members[] = {1, 4, 9, 12};
  for (std::size_t k = 0; k < 4; ++k) {
    const ProbeDirection& direction = answer.directions[k];
    EXPECT_EQ(direction.psi, members[k]);
    const ClippedCell cell = set.clippedCell(direction.psi, {0, 1, 0});
    EXPECT_DOUBLE_EQ(direction.solidAngle, cell.solidAngle);
    EXPECT_DOUBLE_EQ(direction.meanCosine, cell.meanCosine());
    EXPECT_NEAR(length(direction.direction), 1, 1e-12);
    EXPECT_GT(dot(direction.direction, cell.moment), length(cell.moment) * (1 - 1e-12) - 1e-300);
    const double factor = k == 3 ? 0 : members[k];
    EXPECT_NEAR(direction.irradiance.x, factor * (1 + 2), kTolerance * 10);
    EXPECT_NEAR(direction.irradiance.z, factor * (2 + 4), kTolerance * 10);
  }
}

TEST_F(FloorProbe, PhotonsAndErrorAreThoseOfTheTexel) {
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      const ProbeAnswer answer = at(0.5 * x + 0.1, 0.5 * y + 0.4);
      const auto texel = static_cast<std::size_t>(y * 8 + x);
      EXPECT_EQ(answer.photons, static_cast<double>(scene_.maps().photons[texel]));
      EXPECT_EQ(answer.relativeError, static_cast<double>(scene_.maps().relativeError[texel]));
      EXPECT_EQ(answer.standardError, static_cast<double>(scene_.maps().standardError[texel]));
    }
  }
}

TEST_F(FloorProbe, ImpossibleQuestionsAreRefused) {
  const double nan = std::nan(""), inf = HUGE_VAL;
  errorOf(ExitCode::badInput, [&] { at(2, 1.5, 0, {0, 0, 0}); });
  errorOf(ExitCode::badInput, [&] { at(2, 1.5, 0, {0, nan, 0}); });
  errorOf(ExitCode::badInput, [&] { at(2, 1.5, 0, {inf, 0, 0}); });
  errorOf(ExitCode::badInput, [&] { at(nan, 1.5); });
  errorOf(ExitCode::badInput, [&] { at(2, -inf); });
}

TEST_F(FloorProbe, JsonHasTheDocumentedMembers) {
  const nlohmann::json json = toJson(at(1, 2));
  EXPECT_EQ(json["chart"], 0);
  EXPECT_EQ(json["side"], "front");
  EXPECT_NEAR(json["irradiance"][0].get<double>(), 3, kTolerance);
  EXPECT_EQ(json["directions"].size(), 4u);
  EXPECT_EQ(json["directions"][1]["psi"], 4);
  for (const char* key : {"direction", "irradiance"}) EXPECT_EQ(json["directions"][1][key].size(), 3u);
  for (const char* key : {"solid_angle", "mean_cosine"}) EXPECT_TRUE(json["directions"][1][key].is_number());
  EXPECT_TRUE(json["estimated_relative_error"].is_number());
  EXPECT_TRUE(json["photons"].is_number());
  const nlohmann::json nothing = toJson(at(1, 2, 9));
  EXPECT_TRUE(nothing.contains("irradiance") && nothing["irradiance"].is_null());
}

// Two one-sided walls back to back, 1 mm apart, texels of 10 cm: −x is bright, +x brighter; and a sheet that nothing
// lights.
class WallProbe : public ::testing::Test {
 protected:
  WallProbe() : scene_(5) {
    scene_.builder.addDiffuse(Rgb{0.5f});
    scene_.builder.addQuad({0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}, 0);  // faces −x
    scene_.addChart(0, {-1, 0, 0}, 10, 10, 1, 1, 0.1);
    scene_.addSide(false, [](int, int) { return Rgb{1.f}; });
    scene_.builder.addQuad({0.001, 0, 0}, {0.001, 1, 0}, {0.001, 1, 1}, {0.001, 0, 1}, 0);  // faces +x
    scene_.addChart(0, {1, 0, 0}, 10, 10, 13, 1, 0.1);
    scene_.addSide(false, [](int, int) { return Rgb{2.f}; });
    scene_.builder.addQuad({3, 0, 0}, {3, 1, 0}, {3, 1, 1}, {3, 0, 1}, 0);  // faces +x, no light
    scene_.addChart(0, {1, 0, 0}, 1, 1, 1, 13, 1);
    scene_.addUnlitSide(false);
    scene_.builder.addTriangle({3, 0.5, 0.5}, {3, 0.5, 0.5}, {3, 0.6, 0.5}, 0);
    scene_.addTriangleWithoutChart();
    scene_.setAtlas(24, 16);
    dlm_ = scene_.reread(folder_ / "walls.dlm");
    prober_ = std::make_unique<Prober>(dlm_);
  }

  TempFolder folder_;
  BakedScene scene_;
  Dlm dlm_;
  std::unique_ptr<Prober> prober_;
};

TEST_F(WallProbe, OfTwoWallsBackToBackTheNormalChooses) {
  for (const double x : {-0.002, -0.0001, 0.0, 0.0002, 0.0005, 0.0008, 0.001, 0.0011, 0.003}) {
    const ProbeAnswer minus = prober_->probe({x, 0.5, 0.5}, {-1, 0, 0}),
                      plus = prober_->probe({x, 0.5, 0.5}, {1, 0, 0});
    EXPECT_EQ(minus.chart, 0u) << x;
    EXPECT_EQ(plus.chart, 1u) << x;
    EXPECT_NEAR(minus.irradiance.x, 1, 1e-6);
    EXPECT_NEAR(plus.irradiance.x, 2, 1e-6);
    EXPECT_FALSE(minus.back || plus.back);
  }
}

TEST_F(WallProbe, AOneSidedSurfaceIsBlackFromBehind) {
  const ProbeAnswer answer = prober_->probe({3, 0.5, 0.5}, {-1, 0, 0});
  EXPECT_TRUE(answer.onSurface);
  EXPECT_TRUE(answer.back);
  EXPECT_EQ(answer.chart, 2u);
  EXPECT_EQ(answer.irradiance, Rgbd{});
  EXPECT_EQ(answer.photons, 0);
  EXPECT_EQ(toJson(answer)["irradiance"], nlohmann::json({0.0, 0.0, 0.0}));
}

TEST_F(WallProbe, AnUnlitSideIsBlackAndThere) {
  const ProbeAnswer answer = prober_->probe({3, 0.5, 0.5}, {1, 0, 0});
  EXPECT_TRUE(answer.onSurface);
  EXPECT_FALSE(answer.back);
  EXPECT_EQ(answer.irradiance, Rgbd{});
  EXPECT_EQ(answer.photons, 0);
}

// The nearest point by brute force over a fine barycentric grid is never nearer, and not much farther.
TEST(ClosestPoint, AgreesWithAFineSearch) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto random = [&] { return Vec3d{u(rng), u(rng), u(rng)}; };
  for (int i = 0; i < 200; ++i) {
    const Vec3d a = random(), b = random(), c = random(), p = random() * 2.0;
    const ClosestPoint closest = closestPoint(p, a, b, c);
    EXPECT_GE(std::min(closest.b1, closest.b2), 0);
    EXPECT_LE(closest.b1 + closest.b2, 1 + 1e-12);
    double best = 100;
    constexpr int kSteps = 100;
    for (int j = 0; j <= kSteps; ++j) {
      for (int k = 0; j + k <= kSteps; ++k) {
        best = std::min(best, length(a + (b - a) * (1.0 * j / kSteps) + (c - a) * (1.0 * k / kSteps) - p));
      }
    }
    EXPECT_LE(closest.distance, best + 1e-12);
    EXPECT_GE(closest.distance, best - 0.02);
  }
}

TEST(Prober, ManyTrianglesGiveTheSameAnswerAsOneByOneSearch) {
  TempFolder folder;
  BakedScene scene(5);
  scene.builder.addDiffuse(Rgb{0.5f});
  constexpr int kSide = 12;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = i % kSide, z = i / kSide;
    const auto h = [](double px, double pz) { return 0.3 * std::sin(px) + 0.2 * std::cos(1.3 * pz); };
    scene.builder.addQuad({x, h(x, z), z}, {x, h(x, z + 1), z + 1}, {x + 1, h(x + 1, z + 1), z + 1},
                          {x + 1, h(x + 1, z), z});
    MapChart& chart = scene.addChart(0, {0, 1, 0}, 1, 1, 3 * (i % kSide), 3 * (i / kSide), 0.7);
    chart.planar = false;
    scene.addSide(false, [=](int, int) { return Rgb{static_cast<float>(i)}; });
  }
  scene.setAtlas(3 * kSide, 3 * kSide);
  const Dlm dlm = scene.reread(folder / "hills.dlm");
  const Prober prober(dlm);
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(-1, kSide + 1), height(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p{u(rng), height(rng), u(rng)}, n = normalize(Vec3d{0.3, 1, -0.2});
    const Vec3d local = dlm.scene.frame.toLocal(p);
    double best = 0.7 / dlm.scene.frame.scale;
    std::uint32_t chart = kNone;
    for (std::uint32_t t = 0; t < dlm.scene.triangles.size(); ++t) {
      if (dot(normalize(dlm.scene.scaledNormal(t)), n) <= 0.5) continue;
      const double d = closestPoint(local, Vec3d(dlm.scene.corner(t, 0)), Vec3d(dlm.scene.corner(t, 1)),
                                    Vec3d(dlm.scene.corner(t, 2)))
                           .distance;
      if (d < best) {
        best = d;
        chart = dlm.scene.chartOfTriangle[t];
      }
    }
    const ProbeAnswer answer = prober.probe(p, n);
    ASSERT_EQ(answer.chart, chart);
    ASSERT_NEAR(answer.irradiance.x, chart == kNone ? 0 : chart, 1e-6);
  }
}

}  // namespace
}  // namespace lucarne::probe_test
