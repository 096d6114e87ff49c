#include "dlm/direction_shares.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace lucarne::direction_shares_test {
namespace {

TEST(DirectionShares, PartsSumToTheWholeAndAreRightOnAverage) {
  const DirectionShares shares{{0, 1, 2}, {12345, 54321, DirectionWeights::kWhole}};
  for (const std::int64_t units :
       {std::int64_t{0}, std::int64_t{1}, std::int64_t{37}, std::int64_t{1} << 24, (std::int64_t{1} << 56) + 12345}) {
    std::array<double, 3> mean{};
    for (std::uint32_t bits = 0; bits < DirectionWeights::kWhole; ++bits) {
      const auto parts = shares.split(units, bits);
      ASSERT_EQ(std::accumulate(parts.begin(), parts.end(), std::int64_t{0}), units);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_GE(parts[k], 0);
        mean[k] += static_cast<double>(parts[k]) / DirectionWeights::kWhole;
      }
    }
    const std::array<double, 3> weights{12345, 54321 - 12345, DirectionWeights::kWhole - 54321.};
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = static_cast<double>(units) * weights[k] / DirectionWeights::kWhole;
      EXPECT_NEAR(mean[k], expected, 1e-9 * (1 + expected));
    }
  }
}

/// A side that faces up.
MemberSet membersAbove(const DirectionSet& set) {
  MemberSet m;
  for (int psi = 0; psi < set.count(); ++psi)
    if (set.reaches(psi, {0, 0, 1})) m.members.push_back(static_cast<std::uint16_t>(psi));
  for (int psi = 0; psi < set.count(); ++psi) {
    std::size_t best = 0;
    for (std::size_t k = 0; k < m.members.size(); ++k)
      if (dot(set.direction(m.members[k]), set.direction(psi)) >
          dot(set.direction(m.members[best]), set.direction(psi)))
        best = k;
    m.rank.push_back(static_cast<std::uint16_t>(best));
  }
  return m;
}

TEST(DirectionShares, GoToMembersAloneAndAllToTheNearestWhereOneIsNone) {
  const DirectionSet set(32, DirectionFilter::linear);
  const MemberSet members = membersAbove(set);
  ASSERT_LT(members.members.size(), 32u);
  std::mt19937_64 rng(3);
  std::normal_distribution<float> normal;
  int shared = 0, alone = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3f w = normalize(Vec3f{normal(rng), normal(rng), std::abs(normal(rng))});
    const DirectionShares shares = directionShares(set, members, w);
    const DirectionWeights weights = set.triangles()->around(w);
    bool all = true;
    for (std::size_t k = 0; k < 3; ++k) all = all && members.members[members.rank[weights.psi[k]]] == weights.psi[k];
    ++(all ? shared : alone);
    ASSERT_EQ(shares.upTo[2], DirectionWeights::kWhole);
    if (all) {
      for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(members.members[shares.rank[k]], weights.psi[k]);
    } else {
      ASSERT_EQ(shares.upTo[0], DirectionWeights::kWhole);
      ASSERT_EQ(members.members[shares.rank[0]], set.nearest(w));
    }
  }
  EXPECT_GT(shared, 5000);
  EXPECT_GT(alone, 50);
}

TEST(DirectionShares, FewerThanFourDirectionsShareNothing) {
  for (const int count : {1, 2, 3}) {
    const DirectionSet set(count, DirectionFilter::linear);
    EXPECT_EQ(set.triangles(), nullptr);
    EXPECT_EQ(directionShares(set, membersAbove(set), {0.6f, 0, 0.8f}).upTo[0], DirectionWeights::kWhole);
  }
  EXPECT_EQ(DirectionSet(14).triangles(), nullptr);
}

}  // namespace
}  // namespace lucarne::direction_shares_test
