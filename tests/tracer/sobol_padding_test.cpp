#include "tests/tracer/sobol_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/statistics.h"

namespace lucarne::sobol_padding_test {
namespace {

using test::unit;
using test::Words;

/// Variance of the correlation coefficient (known means and variances) of two independently scrambled one-dimensional
/// nets of N points, times N. Words whose indices first share a block of 2^k have correlation c_k = −3·4^-k / 2^(k−1),
/// since 2^k strata are filled once each; the shuffles pair the words at the same k, so that N·variance is 1 + Σ
/// 2^(k−1) c_k².
double paddedVariance() {
  double sum = 1;
  for (int k = 1; k < 30; ++k) {
    const double others = std::ldexp(1.0, k - 1), c = -3 * std::ldexp(1.0, -2 * k) / others;
    sum += others * c * c;
  }
  return sum;
}

struct PaddingScore {
  double worst = 0, meanSquare = 0;  // of z
  int questions = 0;
};

/// Correlations of the words of different blocks over the first photons of several seeds.
PaddingScore padding(const std::function<Words(std::uint64_t seed, std::uint64_t photon, std::uint32_t event)>& words) {
  constexpr std::uint64_t count = 1024, seeds = 40;
  const double se = std::sqrt(paddedVariance() / count);
  PaddingScore score;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    std::array<std::array<double, 16>, 16> sum{};
    for (std::uint64_t i = 0; i < count; ++i) {
      std::array<double, 16> u;
      for (std::uint32_t event = 0; event < 4; ++event) {
        const Words w = words(seed, i, event);
        for (std::size_t d = 0; d < 4; ++d) u[4 * event + d] = (unit(w[d]) - 0.5) * std::sqrt(12.0);
      }
      for (std::size_t a = 0; a < 16; ++a)
        for (std::size_t b = 0; b < a; ++b) sum[a][b] += u[a] * u[b];
    }
    for (std::size_t a = 0; a < 16; ++a)
      for (std::size_t b = 0; b < a / 4 * 4; ++b) {
        const double z = sum[a][b] / count / se;
        score.worst = std::max(score.worst, std::abs(z));
        score.meanSquare += z * z;
        ++score.questions;
      }
  }
  score.meanSquare /= score.questions;
  return score;
}

/// The z are uncorrelated but not quite independent; their squares' mean has a standard error of about √(2/n), and five
/// of them are allowed.
bool independentBlocks(const PaddingScore& s) {
  return s.worst < test::zThreshold(static_cast<std::uint64_t>(s.questions)) &&
         std::abs(s.meanSquare - 1) < 5 * std::sqrt(2.0 / s.questions);
}

TEST(SobolSampler, BlocksAreUncorrelated) {
  const PaddingScore events = padding([](std::uint64_t seed, std::uint64_t photon, std::uint32_t event) {
    return SobolSampler(seed, photon).words(event, Stream::scatter);
  });
  EXPECT_TRUE(independentBlocks(events)) << events.worst << ' ' << events.meanSquare;
  const PaddingScore streams = padding([](std::uint64_t seed, std::uint64_t photon, std::uint32_t event) {
    return SobolSampler(seed, photon).words(event / 3, static_cast<Stream>(event % 3));
  });
  EXPECT_TRUE(independentBlocks(streams)) << streams.worst << ' ' << streams.meanSquare;
  const PaddingScore billions = padding([](std::uint64_t seed, std::uint64_t photon, std::uint32_t k) {
    return SobolSampler(seed, photon + (std::uint64_t{k} << 32)).words(1, Stream::scatter);
  });
  EXPECT_TRUE(independentBlocks(billions)) << billions.worst << ' ' << billions.meanSquare;
  const PaddingScore halves = padding([](std::uint64_t seed, std::uint64_t photon, std::uint32_t k) {
    return SobolSampler(seed, (std::uint64_t{k / 2} << 32) + 2 * photon + k % 2).words(1, Stream::scatter);
  });
  EXPECT_TRUE(independentBlocks(halves)) << halves.worst << ' ' << halves.meanSquare;
  const PaddingScore seeds = padding([](std::uint64_t seed, std::uint64_t photon, std::uint32_t k) {
    return SobolSampler(4 * seed + k, photon).words(1, Stream::scatter);
  });
  EXPECT_TRUE(independentBlocks(seeds)) << seeds.worst << ' ' << seeds.meanSquare;
}

TEST(SobolSampler, TheTestForPaddingRejectsOneOrderForAllBlocks) {
  const auto blocks = [](bool shuffle) {
    return padding([=](std::uint64_t seed, std::uint64_t photon, std::uint32_t event) {
      SobolSeeds seeds = sobolSeeds(mix64(seed), event);
      if (!shuffle) seeds.shuffle = 0;
      return sobolOwen(reverseBits(static_cast<std::uint32_t>(photon)), seeds);
    });
  };
  EXPECT_TRUE(independentBlocks(blocks(true)));
  EXPECT_FALSE(independentBlocks(blocks(false)));
}

}  // namespace
}  // namespace lucarne::sobol_padding_test
