#include "dlm/mean_direction.h"

#include <gtest/gtest.h>

#include <random>

#include "dlm/direction_set.h"
#include "dlm/direction_set_cells.h"
#include "dlm/lobe_width.h"

namespace lucarne::mean_direction_test {
namespace {

constexpr std::array kCounts = {1, 2, 3, 4, 5, 7, 14, 32, 64, 100, 256, 1000};

TEST(MeanDirection, EveryPointOfEveryCellIsWithinReach) {
  for (const int count : kCounts) {
    const std::vector<Vec3d> sites = spreadDirections(count);
    const VoronoiSphere voronoi(sites);
    for (std::size_t psi = 0; psi < sites.size(); ++psi) {
      for (const SphericalPolygon& piece : voronoi.cell(psi)) {
        for (const Vec3d& v : piece.span())
          EXPECT_LE(maxComponent(Vec3d{std::abs(v.x - sites[psi].x), std::abs(v.y - sites[psi].y), std::abs(v.z - sites[psi].z)}),
                    static_cast<double>(meanReach(count)))
              << count;
      }
    }
  }
}

TEST(MeanDirection, PackingErrsByHalfAStepOfTheReach) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const int count : kCounts) {
    const DirectionSet set(count);
    const float reach = meanReach(count), step = 2 * reach / 1023;
    for (int i = 0; i < 200; ++i) {
      const Vec3f m = boundedMean({uniform(rng), uniform(rng), uniform(rng)});
      const Vec3f psi(set.direction(set.nearest(m))), inside = boundedMean(psi + (m - psi) * std::min(1.f, 0.4f * reach));
      const Vec3f back = unpackMean(packMean(inside, psi, reach), psi, reach);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], inside[c], step) << count;
      EXPECT_LE(dot(back, back), 1.00001f);
    }
  }
}

TEST(MeanDirection, PackingWhatWasUnpackedIsTheSameCode) {
  const DirectionSet set(14);
  const float reach = meanReach(14);
  std::mt19937 rng(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3f psi(set.direction(i % 14)), inward = psi * (-0.3f);
    std::uniform_real_distribution<float> uniform(-0.15f, 0.15f);
    const std::uint32_t code = packMean(psi + inward + Vec3f{uniform(rng), uniform(rng), uniform(rng)}, psi, reach);
    EXPECT_TRUE(isMeanCode(code));
    EXPECT_EQ(packMean(unpackMean(code, psi, reach), psi, reach), code);
  }
}

TEST(MeanDirection, ConstantLightOfAWholeCellIsAboutAsSharpAsACell) {
  for (const int count : {14, 32, 64, 256, 1000}) {
    const DirectionSet set(count);
    double mean = 0;
    for (int psi = 0; psi < count; ++psi) {
      const ClippedCell cell = set.cell(psi);
      const float length = static_cast<float>(std::sqrt(dot(cell.moment, cell.moment)) / cell.solidAngle);
      mean += static_cast<double>(meanSharpness(length, count) / cellSharpness(count)) / count;
    }
    EXPECT_NEAR(mean, 0.9, 0.1) << count;
  }
}

TEST(MeanDirection, NothingIsShownSharperThanTheBound) {
  EXPECT_FLOAT_EQ(meanSharpness(1, 32), kMeanBound * cellSharpness(32));
  EXPECT_FLOAT_EQ(meanSharpness(2, 32), kMeanBound * cellSharpness(32));
  EXPECT_GT(meanSharpness(0, 32), 0.f);
  EXPECT_LT(meanSharpness(0, 32), 1e-3f);
}

/// ∫ ω (n·ω) dω over the part of the cell above the horizon, by points.
TEST(MeanDirection, MomentsOfConstantLightAgreeWithQuadrature) {
  constexpr int kPoints = 400'000;
  for (const int count : {1, 3, 14, 64}) {
    const DirectionSet set(count);
    for (const Vec3d& n : {Vec3d{0, 0, 1}, normalize(Vec3d{1, 2, -0.5})}) {
      std::vector<Vec3d> sums(static_cast<std::size_t>(count));
      for (int i = 0; i < kPoints; ++i) {
        const double z = 1 - (2 * i + 1.0) / kPoints, phi = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
        const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
        if (dot(w, n) > 0) sums[static_cast<std::size_t>(set.nearest(Vec3f(w)))] += w * (dot(w, n) * 12.566370614359172 / kPoints);
      }
      for (int psi = 0; psi < count; ++psi) {
        const Vec3d exact = set.cosineMoment(psi, n), other = sums[static_cast<std::size_t>(psi)];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(exact[c], other[c], 5e-4) << count << " " << psi;
        EXPECT_NEAR(dot(exact, n), dot(other, n), 5e-4);
      }
    }
  }
}

}  // namespace
}  // namespace lucarne::mean_direction_test
