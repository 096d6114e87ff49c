// Kernels that adapt to the photons in each texel.
#include "dlm/kernel_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lucarne::kernel_levels_test {
namespace {

constexpr int kWidth = 32, kHeight = 24;
constexpr std::size_t kTexels = kWidth * kHeight;

std::vector<double> widthsOf(double most) {
  std::vector<double> radii;
  for (const Kernel& k : kernelLevels({KernelShape::adaptive, most})) radii.push_back(k.radius);
  return radii;
}

TEST(KernelLevels, GoFromTheTexelItselfToTheWidestInSteps) {
  EXPECT_EQ(widthsOf(4.5), (std::vector<double>{0, 1, 2, 4}));
  EXPECT_EQ(widthsOf(1.5), (std::vector<double>{0, 1}));
  EXPECT_EQ(kernelLevels({KernelShape::pyramid, 4.5}).size(), 1u);
}

/// Levels of a field that is known, with noise of its own in every texel.
struct Field {
  std::vector<Kernel> kernels = kernelLevels({KernelShape::adaptive, 4.5});
  std::vector<double> area = std::vector<double>(kTexels, 1.0), truth;
  SideContacts contacts;
  std::vector<LevelEstimate> estimates;
  std::vector<std::vector<double>> own;

  Field(const std::function<double(int, int)>& value, double deviation, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, deviation);
    std::vector<double> noisy;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        truth.push_back(value(x, y));
        noisy.push_back(truth.back() + normal(random));
      }
    for (const Kernel& kernel : kernels) {
      const SideResolver resolver(kWidth, kHeight, area, kernel, contacts);
      estimates.push_back({resolver.filterValues(noisy),
                           resolver.filterSquares(std::vector<double>(kTexels, deviation * deviation))});
      own.emplace_back(resolver.inverseArea().begin(), resolver.inverseArea().end());
    }
  }
  LevelChoice choose() const {
    return chooseLevels(kWidth, kHeight, estimates, own, std::vector<bool>(kTexels, true));
  }
  double squaredError(const std::vector<std::uint8_t>& level) const {
    double sum = 0;
    for (std::size_t t = 0; t < kTexels; ++t) {
      const double d = estimates[level[t]].value[t] - truth[t];
      sum += d * d;
    }
    return sum / kTexels;
  }
  double squaredError(std::uint8_t level) const { return squaredError(std::vector<std::uint8_t>(kTexels, level)); }
};

TEST(KernelLevels, ConstantLightIsSmoothedWithTheWidest) {
  const Field field([](int, int) { return 5.0; }, 1, 1);
  const LevelChoice choice = field.choose();
  std::size_t widest = 0;
  for (const std::uint8_t l : choice.level) widest += l == 3;
  EXPECT_GT(widest, kTexels * 6 / 10);
  EXPECT_LT(field.squaredError(choice.level), 0.15);
}

TEST(KernelLevels, WithoutNoiseEveryTexelKeepsItsOwnLightWhereLightIsNotLinear) {
  const Field field([](int x, int y) { return std::sin(x * 1.3) + std::cos(y * 0.9); }, 1e-9, 2);
  const LevelChoice choice = field.choose();
  for (std::size_t t = 0; t < kTexels; ++t) ASSERT_EQ(choice.level[t], 0) << t;
  EXPECT_LT(field.squaredError(choice.level), 1e-17);
}

TEST(KernelLevels, AShadowsEdgeIsNotBlurredAndTheRestIsSmoothed) {
  const Field field([](int x, int) { return x < kWidth / 2 ? 1.0 : 11.0; }, 1, 3);
  const LevelChoice choice = field.choose();
  const double chosen = field.squaredError(choice.level);
  for (std::uint8_t l = 0; l < 4; ++l) EXPECT_LT(chosen, field.squaredError(l)) << int{l};
  EXPECT_LT(chosen, 0.6 * std::min(field.squaredError(0), field.squaredError(1)));
}

TEST(KernelLevels, TheBiasThatIsReportedIsThatOfTheChoice) {
  double said = 0, is = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto truth = [](int x, int y) { return 10 + 1.5 * std::sin(x * 0.6) * std::cos(y * 0.5); };
    const Field field(truth, 1, seed), bare(truth, 0, seed);
    const LevelChoice choice = field.choose();
    for (std::size_t t = 0; t < kTexels; ++t) {
      const double bias = bare.estimates[choice.level[t]].value[t] - bare.truth[t];
      said += choice.biasSquared[t];
      is += bias * bias;
    }
  }
  EXPECT_GT(said / is, 0.5);
  EXPECT_LT(said / is, 2);
}

TEST(KernelLevels, AResolverOfLevelsGivesEachTexelItsOwn) {
  const Field field([](int x, int y) { return x + 0.1 * y * y; }, 0.5, 4);
  std::vector<std::uint8_t> level;
  for (std::size_t t = 0; t < kTexels; ++t) level.push_back(static_cast<std::uint8_t>(t * 7 % 4));
  LevelResolver resolver(kWidth, kHeight, field.area, field.kernels, field.contacts);
  resolver.choose(level);
  const std::vector<double> mixed = resolver.filterValues(field.truth);
  for (std::size_t l = 0; l < 4; ++l) {
    const SideResolver one(kWidth, kHeight, field.area, field.kernels[l], field.contacts);
    const std::vector<double> values = one.filterValues(field.truth);
    for (std::size_t t = 0; t < kTexels; ++t) ASSERT_EQ(mixed[t], level[t] == l ? values[t] : mixed[t]);
  }
}

TEST(KernelLevels, TexelsWithoutSurfaceCopyANeighbourOfAnyLevel) {
  std::vector<double> area(kTexels, 0.0), values(kTexels, 0.0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 6; ++x) {
      area[static_cast<std::size_t>(y * kWidth + x)] = 1;
      values[static_cast<std::size_t>(y * kWidth + x)] = 3;
    }
  const std::vector<Kernel> kernels = kernelLevels({KernelShape::adaptive, 4.5});
  const SideContacts contacts;
  LevelResolver resolver(kWidth, kHeight, area, kernels, contacts);
  std::vector<std::uint8_t> level(kTexels, 1);
  for (std::size_t t = 0; t < kTexels; ++t)
    if (area[t] > 0) level[t] = static_cast<std::uint8_t>(t % 4);
  resolver.choose(level);
  for (const double v : resolver.filterValues(values)) ASSERT_NEAR(v, 3, 1e-12);
}

}  // namespace
}  // namespace lucarne::kernel_levels_test
