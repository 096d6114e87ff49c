#include "tests/tracer/sobol_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lucarne::sobol_net_test {
namespace {

using test::Block;
using test::block;
using test::points;
using test::Words;

/// Whether every elementary interval of 2^-bits[d] in dimension d has equally many of the points.
bool evenlyIn(const std::vector<Words>& p, const std::array<int, 4>& bits) {
  const int cells = bits[0] + bits[1] + bits[2] + bits[3];
  std::vector<std::size_t> count(std::size_t{1} << cells, 0);
  for (const Words& w : p) {
    std::uint64_t cell = 0;
    for (std::size_t d = 0; d < 4; ++d) cell = cell << bits[d] | std::uint64_t{w[d]} >> (32 - bits[d]);
    ++count[cell];
  }
  const std::size_t each = p.size() >> cells;
  return std::all_of(count.begin(), count.end(), [&](std::size_t n) { return n == each; });
}

/// Whether the 2^m points are a (t, m)-net in the dimensions of `used`.
bool isNet(const std::vector<Words>& p, int m, int t, const std::array<bool, 4>& used) {
  const int total = m - t;
  for (int a = 0; a <= total; ++a)
    for (int b = 0; a + b <= total; ++b)
      for (int c = 0; a + b + c <= total; ++c) {
        const std::array<int, 4> bits = {a, b, c, total - a - b - c};
        bool asked = true;
        for (std::size_t d = 0; d < 4; ++d) asked = asked && (used[d] || bits[d] == 0);
        if (asked && !evenlyIn(p, bits)) return false;
      }
  return true;
}

/// Blocks of emission and of hits, at all starts.
void forEachBlock(const std::function<void(const Block&, std::uint64_t start)>& f) {
  for (const std::uint64_t start : test::kStarts) {
    SCOPED_TRACE(start);
    f(block<SobolSampler>(0, 0, Stream::emission), start);
    f(block<SobolSampler>(0, 0, Stream::emitter), start);
    f(block<SobolSampler>(1, 1, Stream::scatter), start);
    f(block<SobolSampler>(1, 1, Stream::scatter, true), start);
    f(block<SobolSampler>(~std::uint64_t{0}, 1023, Stream::scatter), start);
  }
}

TEST(SobolSampler, EachDimensionHasOnePointInEveryDyadicInterval) {
  forEachBlock([](const Block& b, std::uint64_t start) {
    for (int m = 0; m <= 16; m += m < 8 ? 1 : 4)
      for (std::size_t d = 0; d < 4; ++d) {
        std::array<bool, 4> used{};
        used[d] = true;
        EXPECT_TRUE(isNet(points(b, start, std::uint64_t{1} << m), m, 0, used)) << "dimension " << d << " m " << m;
      }
  });
}

TEST(SobolSampler, PairsOfDimensionsAreNetsOfThePolynomialsQuality) {
  constexpr int kExcess[] = {0, 0, 1,
                             2};  // degree of the primitive polynomial − 1 (Niederreiter 1987; 0 for the first)
  forEachBlock([&](const Block& b, std::uint64_t start) {
    for (int m = 3; m <= 12; m += 3)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
          std::array<bool, 4> used{};
          used[i] = used[j] = true;
          EXPECT_TRUE(isNet(points(b, start, std::uint64_t{1} << m), m, kExcess[i] + kExcess[j], used))
              << "dimensions " << i << ' ' << j << " m " << m;
        }
  });
}

TEST(SobolSampler, AllFourDimensionsAreNetsWithTThree) {
  constexpr std::array<bool, 4> all = {true, true, true, true};
  forEachBlock([&](const Block& b, std::uint64_t start) {
    for (const int m : {4, 7, 10}) EXPECT_TRUE(isNet(points(b, start, std::uint64_t{1} << m), m, 3, all)) << "m " << m;
  });
}

TEST(SobolSampler, TheTestForNetsRejectsRandomPointsShiftedRangesAndABetterT) {
  constexpr std::array<bool, 4> first = {true, false, false, false}, all = {true, true, true, true};
  EXPECT_FALSE(isNet(points(block<RandomSampler>(0, 1, Stream::scatter), 0, 64), 6, 0, first));
  const Block sobol = block<SobolSampler>(0, 1, Stream::scatter);
  EXPECT_FALSE(isNet(points(sobol, 13, 64), 6, 0, first));
  EXPECT_FALSE(isNet(points(sobol, 0, 256), 8, 2, all));
}

}  // namespace
}  // namespace lucarne::sobol_net_test
