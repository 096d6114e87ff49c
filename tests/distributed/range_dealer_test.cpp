// Dealing photons to ranks: in order, each once, slow ranks get less.
#include "distributed/range_dealer.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/distributed/part_fixture.h"

namespace lucarne::range_dealer_test {
namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

/// Deals all to ranks in random order, each with a rate of its own (photons per second); returns what each got.
std::vector<std::uint64_t> dealAll(IndexRange range, const std::vector<double>& rates, std::uint64_t seed) {
  RangeDealer dealer(range, static_cast<int>(rates.size()));
  test::NumberStream random(seed);
  std::vector<std::uint64_t> got(rates.size(), 0);
  std::uint64_t at = range.begin;
  while (!dealer.empty()) {
    const std::size_t rank = random.upTo(rates.size() - 1);
    const IndexRange piece = dealer.next(static_cast<int>(rank));
    EXPECT_EQ(piece.begin, at);
    EXPECT_GT(piece.end, piece.begin);
    EXPECT_LE(piece.end, range.end);
    if (::testing::Test::HasFailure()) return got;
    at = piece.end;
    EXPECT_EQ(dealer.begin(), at);
    got[rank] += piece.size();
    dealer.finished(static_cast<int>(rank), piece.size(), static_cast<double>(piece.size()) / rates[rank]);
  }
  EXPECT_EQ(at, range.end);
  EXPECT_EQ(dealer.next(0).size(), 0u);
  return got;
}

TEST(RangeDealer, PiecesFollowOneAnotherAndCoverTheRange) {
  for (const std::size_t ranks : {1u, 2u, 3u, 7u, 64u, 1000u})
    for (const IndexRange range :
         {IndexRange{0, 1}, IndexRange{0, 4096}, IndexRange{5, 100'003}, IndexRange{1'000'000, 9'000'000},
          IndexRange{kMost - 1'000'000, kMost}, IndexRange{kMost - 1, kMost}})
      dealAll(range, std::vector<double>(ranks, 1e6), ranks);
}

TEST(RangeDealer, TheLongestRangeIsDealtInPiecesThatFit) {
  dealAll({0, std::uint64_t{1} << 50}, std::vector<double>(4, 1e18), 1);
  RangeDealer dealer({0, kMost}, 2);
  dealer.finished(0, kMost, 1e-300);
  const IndexRange first = dealer.next(0), second = dealer.next(1);
  EXPECT_EQ(first.size(), std::uint64_t{1} << 40);
  EXPECT_EQ(second.begin, first.end);
  EXPECT_EQ(second.size(), 16384u);
}

TEST(RangeDealer, AnEmptyRangeIsDealtFromTheStart) {
  RangeDealer dealer({7, 7}, 3);
  EXPECT_TRUE(dealer.empty());
  EXPECT_EQ(dealer.next(2).size(), 0u);
}

TEST(RangeDealer, APieceIsAboutASecondOfTheRanksWork) {
  RangeDealer dealer({0, 1'000'000'000}, 2);
  EXPECT_EQ(dealer.next(0).size(), 16384u);
  dealer.finished(0, 16384, 0.016384);  // a million per second
  EXPECT_NEAR(static_cast<double>(dealer.next(0).size()), 1e6, 1);
  EXPECT_EQ(dealer.next(1).size(), 16384u) << "of this rank nothing is known yet";
  dealer.finished(1, 16384, 16.384);
  EXPECT_EQ(dealer.next(1).size(), 4096u) << "no smaller than is worth a message";
}

TEST(RangeDealer, NoPieceIsMoreThanHalfTheShareOfWhatIsLeft) {
  RangeDealer dealer({0, 800'000}, 4);
  dealer.finished(0, 1'000'000'000, 1);
  EXPECT_EQ(dealer.next(0).size(), 100'000u);
  EXPECT_EQ(dealer.next(0).size(), 87'500u);
}

TEST(RangeDealer, SlowRanksGetLess) {
  const std::vector<std::uint64_t> got = dealAll({0, 50'000'000}, {1e6, 1e5, 1e4}, 3);
  EXPECT_GT(got[0], 2 * got[1]);
  EXPECT_GT(got[1], 2 * got[2]);
  EXPECT_GT(got[2], 0u);
}

TEST(RangeDealer, PiecesThatTookNoTimeTellNothing) {
  RangeDealer dealer({0, 1'000'000}, 1);
  dealer.finished(0, 0, 1);
  dealer.finished(0, 100, 0);
  dealer.finished(0, 100, -1);
  EXPECT_EQ(dealer.next(0).size(), 16384u);
}

}  // namespace
}  // namespace lucarne::range_dealer_test
