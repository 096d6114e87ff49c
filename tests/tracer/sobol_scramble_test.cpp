#include "tests/tracer/sobol_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/statistics.h"

namespace lucarne::sobol_scramble_test {
namespace {

using test::block;
using test::points;
using test::Words;

TEST(OwenScramble, FlipsEachBitAsTheBitsBeforeItSay) {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const std::uint64_t r = mix64(i), s = mix64(~i);
    const auto a = static_cast<std::uint32_t>(r), seed = static_cast<std::uint32_t>(s);
    const int shared = static_cast<int>(s >> 59);  // of the low bits, 0 to 31
    const auto b =
        a ^ (std::uint32_t{1} << shared) ^ (shared < 31 ? static_cast<std::uint32_t>(r >> 32) << (shared + 1) : 0);
    EXPECT_EQ(std::countr_zero(owenReversed(a, seed) ^ owenReversed(b, seed)), shared);
  }
}

/// p-value of what two words that first differ at bit `split` become: that bit and the next two of each, over seeds.
double pairP(std::uint32_t a, std::uint32_t b, int split,
             const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& scramble) {
  constexpr int samples = 20'000;
  std::vector<double> observed(32, 0), expected(32, samples / 32.0);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const auto seed = static_cast<std::uint32_t>(mix64(i));
    const std::uint32_t x = scramble(a, seed) >> split, y = scramble(b, seed) >> split;
    ++observed[(x & 7u) << 2 | (y >> 1 & 3u)];
  }
  return test::chiSquareP(observed, expected);
}

/// The worst p-value of pairs that split early, times their number.
double worstPairP(const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& scramble) {
  constexpr int splits = 6, pairs = 8;
  double worst = 1;
  for (int split = 0; split < splits; ++split)
    for (std::uint64_t k = 0; k < pairs; ++k) {
      const std::uint64_t r = mix64(pairs * static_cast<std::uint64_t>(split) + k);
      const auto a = static_cast<std::uint32_t>(r), low = (std::uint32_t{2} << split) - 1;
      const auto b = (static_cast<std::uint32_t>(r >> 32) & ~low) | ((a ^ (std::uint32_t{1} << split)) & low);
      worst = std::min(worst, pairP(a, b, split, scramble));
    }
  return worst * splits * pairs;
}

// Owen's variance (1997, "Monte Carlo variance of scrambled net quadrature") asks for this and no more: 32 bits of seed
// could not make all flips of a level independent of each other.
TEST(OwenScramble, TwoWordsAreIndependentPastTheBitTheyFirstDifferIn) {
  EXPECT_GT(worstPairP(owenReversed<std::uint32_t>), 1e-4);
  EXPECT_LT(worstPairP([](std::uint32_t x, std::uint32_t seed) { return x ^ seed; }), 1e-4);  // a shift, not nested
}

/// p-value of the byte `shift` bits up in word d of one photon being uniform over seeds.
double uniformOverSeedsP(std::uint64_t photon, std::size_t d, int shift) {
  constexpr int samples = 40'000;
  std::vector<double> observed(256, 0), expected(256, samples / 256.0);
  for (std::uint64_t seed = 0; seed < samples; ++seed)
    ++observed[SobolSampler(seed, photon).words(1, Stream::scatter)[d] >> shift & 0xffu];
  return test::chiSquareP(observed, expected);
}

TEST(SobolSampler, EachWordOfAPhotonIsUniformOverSeedsInItsTopAndItsLowBits) {
  int questions = 0;
  double worst = 1;
  for (const std::uint64_t photon : {std::uint64_t{0}, std::uint64_t{5}, (std::uint64_t{1} << 32) + 12345})
    for (std::size_t d = 0; d < 4; ++d)
      for (const int shift : {0, 12, 24}) {
        worst = std::min(worst, uniformOverSeedsP(photon, d, shift));
        ++questions;
      }
  EXPECT_GT(worst, 1e-4 / questions);
}

TEST(SobolSampler, TwoWordsOfAPhotonAreIndependentOverSeeds) {
  constexpr int samples = 40'000;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      std::vector<double> observed(256, 0), expected(256, samples / 256.0);
      for (std::uint64_t seed = 0; seed < samples; ++seed) {
        const Words w = SobolSampler(seed, 77).words(2, Stream::scatter);
        ++observed[(w[i] >> 28) << 4 | w[j] >> 28];
      }
      EXPECT_GT(test::chiSquareP(observed, expected), 1e-5) << i << ' ' << j;
    }
}

// Rounding takes the low bits of the words of one block, photon after photon.
TEST(SobolSampler, LowBitsOfOneBlockAreUniformAndIndependentOfTheTopAndOfTheNextPhotons) {
  constexpr std::uint64_t samples = 1 << 18;
  const auto p = points(block<SobolSampler>(3, 1, Stream::scatter), 0, samples + 1);
  for (std::size_t d = 0; d < 4; ++d) {
    std::vector<double> byte(256, 0), withTop(256, 0), withNext(256, 0), expected(256, samples / 256.0);
    for (std::size_t i = 0; i < samples; ++i) {
      ++byte[p[i][d] & 0xffu];
      ++withTop[(p[i][d] >> 28) << 4 | (p[i][d] >> 4 & 15u)];
      ++withNext[(p[i][d] >> 4 & 15u) << 4 | (p[i + 1][d] >> 4 & 15u)];
    }
    EXPECT_GT(test::chiSquareP(byte, expected), 1e-5) << d;
    EXPECT_GT(test::chiSquareP(withTop, expected), 1e-5) << d;
    EXPECT_GT(test::chiSquareP(withNext, expected), 1e-5) << d;
  }
}

}  // namespace
}  // namespace lucarne::sobol_scramble_test
