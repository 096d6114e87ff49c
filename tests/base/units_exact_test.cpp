// Exact counts: what is written can be typed again.
#include <gtest/gtest.h>

#include <limits>

#include "base/units.h"

namespace lucarne::units_exact_test {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

void expectComesBack(std::uint64_t count) {
  const std::string text = formatExactCount(count);
  EXPECT_EQ(parseCount("--photons", text), count) << text;
  EXPECT_LE(text.size(), std::to_string(count).size()) << count;
}

TEST(FormatExactCount, IsReadAsTheSameNumber) {
  for (std::uint64_t i = 0; i < 20'000; ++i) expectComesBack(i);
  for (int bit = 0; bit < 64; ++bit)
    for (const std::uint64_t power : {std::uint64_t{1} << bit, kMost >> bit}) {
      for (std::uint64_t i = 0; i < 3; ++i) expectComesBack(power - i);
      if (power < kMost) expectComesBack(power + 1);
    }
  std::uint64_t x = 1;
  for (int i = 0; i < 20'000; ++i) {
    x = x * 6364136223846793005u + 1442695040888963407u;
    expectComesBack(x >> (i % 64));
  }
}

TEST(FormatExactCount, IsReadAsTheSameNumberAroundRoundOnes) {
  for (std::uint64_t round = 1;; round *= 10) {
    for (const std::uint64_t factor : {1u, 2u, 5u, 9u})
      for (const std::uint64_t offset : {0u, 1u, 10u, 500u})
        if (round <= (kMost - offset) / factor) expectComesBack(round * factor + offset);
    if (round > kMost / 10) break;
  }
}

TEST(FormatExactCount, IsAsShortAsItCanBe) {
  EXPECT_EQ(formatExactCount(0), "0");
  EXPECT_EQ(formatExactCount(1000), "1k");
  EXPECT_EQ(formatExactCount(2500), "2500");  // no longer than "2.5k"
  EXPECT_EQ(formatExactCount(2'500'000), "2.5M");
  EXPECT_EQ(formatExactCount(20'000'000), "20M");
  EXPECT_EQ(formatExactCount(1'234'567), "1234567");
  EXPECT_EQ(formatExactCount(1'000'000'000'001), "1000000000001");
  EXPECT_EQ(formatExactCount(kMost), "18446744073709551615");
}

}  // namespace
}  // namespace lucarne::units_exact_test
