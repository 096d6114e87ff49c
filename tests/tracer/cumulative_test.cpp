#include "tracer/optics/cumulative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lucarne::cumulative_test {
namespace {

struct Table {
  std::vector<double> cumulative;
  std::vector<std::uint32_t> guide;
  double total;

  explicit Table(std::vector<double> weights) : cumulative(std::move(weights)), guide(cumulative.size()) {
    total = makeCumulative(cumulative);
    makeGuide(cumulative, guide);
  }
  /// By bisection, without the guide.
  std::size_t expected(double u) const {
    return static_cast<std::size_t>(std::upper_bound(cumulative.begin(), cumulative.end(), u) - cumulative.begin());
  }
};

/// Each end of a choice, each step of the guide, and the numbers just beside them.
void expectInversion(const Table& table) {
  const std::size_t n = table.cumulative.size();
  std::vector<double> numbers{0, 1 - 0x1p-53};
  for (std::size_t i = 0; i < n; ++i) {
    for (const double u : {table.cumulative[i], static_cast<double>(i) / static_cast<double>(n)})
      numbers.insert(numbers.end(), {u, std::nextafter(u, 0), std::nextafter(u, 1)});
  }
  for (const double u : numbers) {
    if (!(u < 1)) continue;
    const Choice choice = choose(table.cumulative, table.guide, u);
    ASSERT_EQ(choice.index, table.expected(u)) << u << " of " << n;
    ASSERT_GE(choice.rest, 0);
    ASSERT_LT(choice.rest, 1);
  }
}

TEST(Cumulative, ChoosesAsBisectionDoesForEqualAndForUnequalWeights) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-12, 0);
  for (const std::size_t n : {1u, 2u, 3u, 7u, 49u, 100u, 333u, 1000u}) {
    expectInversion(Table(std::vector<double>(n, 1.0)));
    std::vector<double> weights(n);
    for (double& w : weights) w = random() % 3 == 0 ? 0 : std::pow(10, exponent(random));
    weights[n / 2] = 1;
    expectInversion(Table(weights));
  }
}

TEST(Cumulative, LastIsOneAndTheTotalIsTheSum) {
  const Table table({0.1, 0.2, 0, 0.7, 0});
  EXPECT_DOUBLE_EQ(table.total, 1);
  EXPECT_EQ(table.cumulative.back(), 1);
  const Table nothing({0, 0, 0});
  EXPECT_EQ(nothing.total, 0);
  EXPECT_EQ(nothing.cumulative.back(), 0);
}

TEST(Cumulative, TheRestIsWhereTheNumberLiesBetweenTheEndsOfItsChoice) {
  const Table table({1, 3, 4});
  EXPECT_DOUBLE_EQ(choose(table.cumulative, table.guide, 0.0625).rest, 0.5);
  EXPECT_DOUBLE_EQ(choose(table.cumulative, table.guide, 0.125).rest, 0);
  EXPECT_DOUBLE_EQ(choose(table.cumulative, table.guide, 0.875).rest, 0.75);
}

}  // namespace
}  // namespace lucarne::cumulative_test
