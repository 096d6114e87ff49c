#include "tests/tracer/sobol_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "tests/support/statistics.h"

namespace lucarne::sobol_test {
namespace {

using test::Block;
using test::block;
using test::unit;
using test::Words;

TEST(Sobol, GivesThePublishedPoints) {
  // Four dimensions of new-joe-kuo-6.21201 in the order of the Gray code, in eighths.
  constexpr int kEighths[8][4] = {{0, 0, 0, 0}, {4, 4, 4, 4}, {6, 2, 2, 2}, {2, 6, 6, 6},
                                  {3, 3, 5, 7}, {7, 7, 1, 3}, {5, 1, 7, 5}, {1, 5, 3, 1}};
  for (std::uint32_t n = 0; n < 8; ++n) {
    const auto p = std::bit_cast<Words>(reverseBits(sobolReversed(reverseBits(n ^ (n >> 1)))));
    for (std::size_t d = 0; d < 4; ++d) EXPECT_EQ(p[d], static_cast<std::uint32_t>(kEighths[n][d]) << 29) << n;
  }
}

TEST(Sobol, ReversingTwiceChangesNothing) {
  EXPECT_EQ(reverseBits(0x00000001u), 0x80000000u);
  EXPECT_EQ(reverseBits(0x12345678u), 0x1e6a2c48u);
  EXPECT_EQ(reverseBits(reverseBits(0xdeadbeefu)), 0xdeadbeefu);
}

/// Slope of log(RMS error) over log(N) of the mean of f(word i, word j) over the first N photons, N = 2^6 … 2^13.
double convergence(const std::function<Block(std::uint64_t seed)>& make, std::size_t i, std::size_t j) {
  constexpr int first = 6, last = 13, seeds = 32;
  const auto f = [](double x, double y) { return std::exp(x + y * y) * std::cos(2 * x * y); };
  double truth = 0;  // by the midpoint rule, to 1e-7
  constexpr int n = 2000;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) truth += f((a + 0.5) / n, (b + 0.5) / n) / (double(n) * n);
  std::array<double, last + 1> squares{};
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Block block = make(seed);
    double sum = 0;
    for (std::uint64_t k = 0; k < std::uint64_t{1} << last; ++k) {
      const Words w = block(k);
      sum += f(unit(w[i]), unit(w[j]));
      if (const auto count = static_cast<double>(k + 1); std::has_single_bit(k + 1))
        squares[static_cast<std::size_t>(std::countr_zero(k + 1))] += (sum / count - truth) * (sum / count - truth);
    }
  }
  double mm = 0, me = 0;  // least squares about the middle
  for (int m = first; m <= last; ++m) {
    const double x = m - 0.5 * (first + last);
    mm += x * x;
    me += x * 0.5 * std::log2(squares[static_cast<std::size_t>(m)]);
  }
  return me / mm;
}

TEST(SobolSampler, SmoothIntegralsConvergeFasterThanThoseOfRandomNumbers) {
  const auto sobol = [](std::uint64_t seed) { return block<SobolSampler>(seed, 1, Stream::scatter); };
  const auto random = [](std::uint64_t seed) { return block<RandomSampler>(seed, 1, Stream::scatter); };
  EXPECT_NEAR(convergence(random, 0, 1), -0.5, 0.12);
  EXPECT_LT(convergence(sobol, 0, 1), -1.2);
  EXPECT_LT(convergence(sobol, 1, 2), -1.2);
  EXPECT_LT(convergence(sobol, 2, 3), -1.0);
}

TEST(SobolSampler, GivesTheSameWordsEveryTime) {
  for (const std::uint64_t photon : test::kStarts)
    EXPECT_EQ(SobolSampler(9, photon).words(3, Stream::scatter), SobolSampler(9, photon).words(3, Stream::scatter));
  // Whatever the compiler and the machine: bakes are repeated on others.
  EXPECT_EQ(SobolSampler(0, 0).words(0, Stream::emission), (Words{2386165368u, 137045325u, 1820597669u, 664637878u}));
  EXPECT_EQ(SobolSampler(42, (std::uint64_t{1} << 40) + 7).words(3, Stream::scatter),
            (Words{2498698677u, 701889885u, 1770734695u, 2276838150u}));
}

TEST(SobolSampler, StreamsEventsPhotonsAndSeedsAreAllDifferent) {
  std::set<Words> seen;
  for (const std::uint64_t seed : {0ull, 1ull, 1ull << 40})
    for (const std::uint64_t photon : {0ull, 1ull, 1ull << 32, 1ull << 40})
      for (std::uint32_t event = 0; event < 3; ++event)
        for (const Stream stream : {Stream::scatter, Stream::emitter, Stream::emission})
          EXPECT_TRUE(seen.insert(SobolSampler(seed, photon).words(event, stream)).second);
}

TEST(SobolSampler, PicksOfEmittersAreStratifiedAndFineToTheLastBit) {
  constexpr int samples = 1 << 14;
  const auto check = [](const std::function<double(const SobolSampler&)>& pick) {
    std::vector<int> strata(samples, 0);
    std::vector<double> observed(128, 0), expected(128, samples / 128.0);
    for (std::uint64_t i = 0; i < samples; ++i) {
      const double u = pick(SobolSampler(4, 2 * i));
      ++strata[static_cast<std::size_t>(u * samples)];
      ++observed[static_cast<std::uint64_t>(std::ldexp(u, 53)) & 127u];
    }
    EXPECT_EQ(*std::min_element(strata.begin(), strata.end()), 1);
    EXPECT_GT(test::chiSquareP(observed, expected), 1e-4);
  };
  check([](const SobolSampler& s) { return s.emission().pick; });
}

// A pick of one of 16 emitters leaves 2^10 photons of 2^14 to each.
TEST(SobolSampler, PhotonsOfOneEmitterAreStratifiedInWhatIsLeftOfThePickAndTheNextNumber) {
  constexpr int samples = 1 << 14, emitters = 16, across = 32;
  std::vector<int> cells(samples, 0);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const EmissionNumbers e = SobolSampler(4, 2 * i + 1).emission();
    const double scaled = e.pick * emitters, rest = scaled - std::floor(scaled);
    const int cell = (static_cast<int>(scaled) * across + static_cast<int>(rest * across)) * across +
                     static_cast<int>(e.others[0] * across);
    ++cells[static_cast<std::size_t>(cell)];
  }
  EXPECT_EQ(*std::min_element(cells.begin(), cells.end()), 1);
}

TEST(SobolSampler, NumbersOfTheEmissionAreThoseOfTheBlocks) {
  const SobolSampler s(4, 123456789);
  const auto u = s.floats(0, Stream::emission);
  EXPECT_EQ(s.emission().others, (std::array<float, 3>{u[1], u[2], u[3]}));
  EXPECT_EQ(static_cast<float>(std::floor(s.emission().pick * 0x1p24) * 0x1p-24), u[0]);
}

TEST(RandomSampler, PicksEmittersByTwoWordsOfABlockOfTheirOwn) {
  const RandomSampler s(4, 123456789);
  const Words w = s.words(0, Stream::emitter);
  EXPECT_EQ(s.emission().pick, toUnitDouble(w[0], w[1]));
}

}  // namespace
}  // namespace lucarne::sobol_test
