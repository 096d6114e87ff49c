// Sets of photon indices against sets of numbers, and shares of a whole against the whole.
#include "distributed/index_set.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "base/units.h"
#include "tests/distributed/part_fixture.h"

namespace lucarne::index_set_test {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
using Pairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

Pairs pairs(const IndexSet& set) {
  Pairs list;
  for (const IndexRange& r : set.ranges()) list.emplace_back(r.begin, r.end);
  return list;
}

IndexSet setOf(const Pairs& ranges) {
  IndexSet set;
  for (const auto& [begin, end] : ranges) set.add({begin, end});
  return set;
}

std::set<std::uint64_t> numbersIn(const IndexSet& set) {
  std::set<std::uint64_t> numbers;
  for (const IndexRange& r : set.ranges())
    for (std::uint64_t i = r.begin; i < r.end; ++i) numbers.insert(i);
  return numbers;
}

TEST(IndexSet, TouchingRangesBecomeOneInAnyOrder) {
  EXPECT_EQ(pairs(setOf({{0, 5}, {5, 9}})), (Pairs{{0, 9}}));
  EXPECT_EQ(pairs(setOf({{5, 9}, {0, 5}})), (Pairs{{0, 9}}));
  EXPECT_EQ(pairs(setOf({{0, 5}, {7, 9}, {5, 7}})), (Pairs{{0, 9}}));
  EXPECT_EQ(pairs(setOf({{7, 9}, {0, 5}})), (Pairs{{0, 5}, {7, 9}}));
  EXPECT_EQ(pairs(setOf({{kMost - 1, kMost}, {0, 1}, {1, kMost - 1}})), (Pairs{{0, kMost}}));
}

TEST(IndexSet, EmptyRangesAddNothing) {
  EXPECT_TRUE(setOf({{3, 3}, {0, 0}, {kMost, kMost}}).empty());
  EXPECT_EQ(IndexSet().end(), 0u);
  EXPECT_EQ(IndexSet().count(), 0u);
}

TEST(IndexSet, APhotonCountedTwiceIsABrokenContract) {
  for (const IndexRange& r :
       {IndexRange{10, 20}, IndexRange{5, 11}, IndexRange{19, 25}, IndexRange{12, 13}, IndexRange{0, 100}}) {
    IndexSet set(IndexRange{10, 20});
    EXPECT_THROW(set.add(r), std::logic_error) << r.begin;
    EXPECT_EQ(pairs(set), (Pairs{{10, 20}}));
  }
}

TEST(IndexSet, AgreesWithASetOfNumbers) {
  test::NumberStream random(1);
  for (int round = 0; round < 300; ++round) {
    IndexSet a, b;
    for (IndexSet* set : {&a, &b})
      for (int i = 0; i < 6; ++i) {
        const std::uint64_t begin = random.upTo(40);
        const IndexRange r{begin, begin + random.upTo(8)};
        if (r.size() > 0 && set->common(IndexSet(r)).empty()) set->add(r);
      }
    const std::set<std::uint64_t> inA = numbersIn(a), inB = numbersIn(b);
    std::set<std::uint64_t> both, gaps;
    for (std::uint64_t i = 0; i < 60; ++i) {
      if (inA.contains(i) && inB.contains(i)) both.insert(i);
      if (i >= 10 && i < 35 && !inA.contains(i)) gaps.insert(i);
    }
    EXPECT_EQ(a.count(), inA.size());
    EXPECT_EQ(a.countOdd(), std::count_if(inA.begin(), inA.end(), [](std::uint64_t i) { return i % 2 == 1; }));
    EXPECT_EQ(numbersIn(a.common(b)), both);
    EXPECT_TRUE(a.common(b) == b.common(a));
    EXPECT_EQ(numbersIn(a.missing({10, 35})), gaps);
    EXPECT_EQ(a.contains({10, 35}), gaps.empty());
  }
}

TEST(IndexSet, TheOrderOfAddingDoesNotShow) {
  test::NumberStream random(2);
  Pairs pieces;
  for (std::uint64_t at = 0; at < 1000;) {
    const std::uint64_t end = at + 1 + random.upTo(20);
    if (random.upTo(3) > 0) pieces.emplace_back(at, end);
    at = end;
  }
  const IndexSet inOrder = setOf(pieces);
  for (int round = 0; round < 20; ++round) {
    for (std::size_t i = pieces.size(); i > 1; --i) std::swap(pieces[i - 1], pieces[random.upTo(i - 1)]);
    EXPECT_TRUE(setOf(pieces) == inOrder);
  }
}

TEST(IndexSet, SetsAddUpAndWhatIsMissingCompletesThem) {
  IndexSet set = setOf({{2, 4}, {8, kMost - 5}});
  const IndexSet gaps = set.missing({0, kMost});
  EXPECT_EQ(pairs(gaps), (Pairs{{0, 2}, {4, 8}, {kMost - 5, kMost}}));
  EXPECT_TRUE(set.common(gaps).empty());
  set.add(gaps);
  EXPECT_EQ(pairs(set), (Pairs{{0, kMost}}));
  EXPECT_EQ(set.count(), kMost);
  EXPECT_EQ(set.countOdd(), kMost / 2);
  EXPECT_TRUE(set.contains({0, kMost}));
  EXPECT_TRUE(set.missing({5, 5}).empty());
}

/// The shares follow one another from 0 to `photons` and differ by at most one.
void expectSharesCover(std::uint64_t photons, std::uint64_t n) {
  std::uint64_t at = 0;
  for (std::uint64_t k = 1; k <= n; ++k) {
    const IndexRange share = shareOf(photons, k, n);
    ASSERT_EQ(share.begin, at) << photons << " " << k << "/" << n;
    ASSERT_LE(share.begin, share.end);
    ASSERT_GE(share.size(), photons / n);
    ASSERT_LE(share.size() - photons / n, 1u);
    at = share.end;
  }
  EXPECT_EQ(at, photons) << n;
}

TEST(ShareOf, SharesHoldEveryPhotonOnceAndAreAlike) {
  for (const std::uint64_t photons :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{7}, std::uint64_t{1000},
        std::uint64_t{20'000'000}, (std::uint64_t{1} << 40) + 1, kMost - 1, kMost})
    for (const std::uint64_t n : {1u, 2u, 3u, 7u, 16u, 999u, 4096u}) expectSharesCover(photons, n);
}

TEST(ShareOf, IsExactForAsManyPartsAsPhotons) {
  for (const std::uint64_t k : {std::uint64_t{1}, std::uint64_t{2}, kMost / 2, kMost - 1, kMost}) {
    const IndexRange share = shareOf(kMost, k, kMost);
    EXPECT_EQ(share.begin, k - 1);
    EXPECT_EQ(share.end, k);
  }
  EXPECT_EQ(shareOf(kMost, kMost - 1, kMost - 1).end, kMost);
  EXPECT_EQ(shareOf(1, kMost, kMost).end, 1u);
  EXPECT_EQ(shareOf(1, kMost - 1, kMost).size(), 0u);
}

TEST(ShareOf, PartZeroAndPartsBeyondTheLastAreBrokenContracts) {
  EXPECT_THROW(shareOf(10, 0, 4), std::logic_error);
  EXPECT_THROW(shareOf(10, 5, 4), std::logic_error);
}

TEST(IndexSetText, IsExactShortAndCut) {
  EXPECT_EQ(toText(IndexSet()), "none");
  EXPECT_EQ(toText(setOf({{0, 2'500'000}, {5'000'000, 7'500'000}})), "0..2.5M, 5M..7.5M");
  EXPECT_EQ(toText(setOf({{0, 1'234'567}})), "0..1234567");
  EXPECT_EQ(toText(setOf({{0, kMost}})), "0.." + formatExactCount(kMost));
  IndexSet many;
  for (std::uint64_t i = 0; i < 9; ++i) many.add({2 * i, 2 * i + 1});
  EXPECT_EQ(toText(many), "0..1, 2..3, 4..5, 6..7, 8..9, 10..11 and 3 more ranges");
}

}  // namespace
}  // namespace lucarne::index_set_test
