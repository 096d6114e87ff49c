// The pieces that a texel's standard error is made of.
#include "dlm/texel_error.h"

#include <gtest/gtest.h>

#include <random>

namespace lucarne::texel_error_test {
namespace {

TEST(TexelError, TheNeighbourhoodGrowsUntilItHasPhotonsFromAnySmallestRadius) {
  const int width = 9, height = 7;
  std::vector<double> photons(63, 0.0), squares(63, 0.0);
  const std::vector<double> area(63, 0.5);
  photons[3 * width + 4] = 40;
  squares[3 * width + 4] = 80;
  const NeighbourSquares n(width, height, photons, squares, area);
  for (const int radius : {0, 1, 2, 100}) {
    EXPECT_GT(n.density(4, 3, radius), 0) << radius;
    EXPECT_GT(n.density(0, 0, radius), 0) << radius;
  }
  EXPECT_NEAR(n.density(4, 3, 0), 80 / 4.5, 1e-12);   // 3 × 3 texels
  EXPECT_NEAR(n.density(4, 3, 100), 80 / 31.5, 1e-12);
  EXPECT_EQ(NeighbourSquares(width, height, std::vector<double>(63, 0.0), std::vector<double>(63, 0.0), area).density(1, 1, 0), 0);
}

TEST(TexelError, PhotonsWhereNoSurfaceIsOpenSayNothingOfTheSurfaceAroundThem) {
  constexpr int width = 40, height = 40;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  std::vector<double> photons(width * height), squares(width * height), area(width * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto t = static_cast<std::size_t>(y * width + x);
      const bool hidden = x >= 10 && x < 30 && y >= 10 && y < 30;
      area[t] = hidden ? 0 : uniform(random);
      photons[t] = 5;
      squares[t] = hidden ? 1000 : 3 * area[t];
    }
  }
  const NeighbourSquares n(width, height, photons, squares, area);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) EXPECT_NEAR(n.density(x, y, 1), 3, 1e-6) << x << ", " << y;
}

TEST(TexelError, TheRatioIsThatOfTheDifferencesAndOneWhereNothingIsKnown) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  std::vector<double> differences;
  for (int i = 0; i < 20'000; ++i) differences.push_back(0.8 * normal(random));
  const std::vector<double> variances(differences.size(), 1.0), many(differences.size(), 100.0), few(differences.size(), 1.0);
  const ErrorRatios known = measureErrorRatios(differences, variances, many, 5);
  const std::size_t c = ErrorRatios::classOf(100);
  EXPECT_NEAR(errorRatio(known, known, c), 0.64, 0.02);
  EXPECT_NEAR(errorRatio(known, known, c + 1), 0.64, 0.02) << "a class that says nothing is as the others are";
  const ErrorRatios unknown = measureErrorRatios(differences, variances, few, 5);
  EXPECT_EQ(unknown.total().texels, 0);
  EXPECT_EQ(errorRatio(unknown, unknown, c), 1);
  EXPECT_NEAR(errorRatio(unknown, known, c), 0.64, 0.02) << "a side that says nothing is as the others are";
}

TEST(TexelError, ClassesOfPhotonsAreToldApart) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0, 1);
  std::vector<double> differences, photons;
  for (int i = 0; i < 20'000; ++i) {
    photons.push_back(i % 2 == 0 ? 20 : 5000);
    differences.push_back((i % 2 == 0 ? 1 : 0.5) * normal(random));
  }
  const ErrorRatios ratios = measureErrorRatios(differences, std::vector<double>(20'000, 1.0), photons, 5);
  EXPECT_NEAR(errorRatio(ratios, ratios, ErrorRatios::classOf(20)), 1, 0.04);
  EXPECT_NEAR(errorRatio(ratios, ratios, ErrorRatios::classOf(5000)), 0.25, 0.02);
}

TEST(TexelError, NeighboursCountForAllWhereThereAreNoPhotonsAndForNothingWhereThereAreMany) {
  EXPECT_EQ(neighbourShare(0), 1);
  EXPECT_NEAR(neighbourShare(3), 0.5, 1e-12);
  EXPECT_LT(neighbourShare(100), 1e-3);
}

}  // namespace
}  // namespace lucarne::texel_error_test
