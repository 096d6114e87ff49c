#include "dlm/pack.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/error.h"

namespace lucarne::test::pack_test {
namespace {

double fill(const std::vector<RectSize>& sizes, const Packing& packing, int gutter) {
  double area = 0;
  for (const RectSize& s : sizes) area += double(s.width + 2 * gutter) * (s.height + 2 * gutter);
  return area / (double(packing.pageWidth) * packing.pageHeight * packing.pageCount);
}

/// No two rectangles meet, gutters and all, and all lie inside a page.
void expectDisjoint(const std::vector<RectSize>& sizes, const Packing& packing, int gutter) {
  ASSERT_EQ(packing.places.size(), sizes.size());
  EXPECT_EQ(packing.pageWidth % 4, 0);
  EXPECT_EQ(packing.pageHeight % 4, 0);
  std::vector<std::vector<bool>> used(static_cast<std::size_t>(packing.pageCount));
  const auto width = static_cast<std::size_t>(packing.pageWidth);
  for (auto& page : used) page.assign(width * static_cast<std::size_t>(packing.pageHeight), false);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Placement p = packing.places[i];
    ASSERT_TRUE(p.page >= 0 && p.page < packing.pageCount);
    ASSERT_TRUE(p.x >= gutter && p.x + sizes[i].width + gutter <= packing.pageWidth);
    ASSERT_TRUE(p.y >= gutter && p.y + sizes[i].height + gutter <= packing.pageHeight);
    for (int y = p.y - gutter; y < p.y + sizes[i].height + gutter; ++y) {
      for (int x = p.x - gutter; x < p.x + sizes[i].width + gutter; ++x) {
        auto texel =
            used[static_cast<std::size_t>(p.page)][static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
        ASSERT_FALSE(texel) << "rectangle " << i;
        texel = true;
      }
    }
  }
}

/// Sides spread over powers of two, most of them small: as charts are.
std::vector<RectSize> chartLike(std::size_t count, int largest, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  const auto side = [&] {
    return std::max(1, static_cast<int>(std::pow(double(largest), std::pow(uniform(random), 3))));
  };
  std::vector<RectSize> sizes(count);
  for (RectSize& s : sizes) s = {side(), side()};
  return sizes;
}

TEST(Pack, RectanglesNeverMeetAndStayInside) {
  for (const std::size_t count : {1u, 2u, 7u, 100u, 1999u, 2000u, 20000u}) {
    for (const int gutter : {0, 1, 3}) {
      const std::vector<RectSize> sizes = chartLike(count, 200);
      PackOptions options;
      options.gutter = gutter;
      const Packing packing = packRectangles(sizes, options);
      expectDisjoint(sizes, packing, gutter);
      EXPECT_LE(packing.pageWidth, 4096);
      EXPECT_LE(packing.pageHeight, 4096);
    }
  }
}

TEST(Pack, LittleIsWastedAndPagesAreNearlySquare) {
  for (const std::size_t count : {300u, 3000u, 30000u}) {
    const std::vector<RectSize> sizes = chartLike(count, 150);
    const Packing packing = packRectangles(sizes, {});
    EXPECT_EQ(packing.pageCount, 1);
    EXPECT_GT(fill(sizes, packing, 1), count < 1000 ? 0.82 : 0.95) << count;
    EXPECT_LT(std::max(packing.pageWidth, packing.pageHeight), 1.3 * std::min(packing.pageWidth, packing.pageHeight));
  }
}

TEST(Pack, ManyPagesAreAboutEquallyFull) {
  const std::vector<RectSize> sizes = chartLike(20000, 120);
  PackOptions options;
  options.maxPageSize = 256;
  const Packing packing = packRectangles(sizes, options);
  expectDisjoint(sizes, packing, 1);
  EXPECT_GT(packing.pageCount, 3);
  EXPECT_LE(std::max(packing.pageWidth, packing.pageHeight), 256);
  EXPECT_GT(fill(sizes, packing, 1), 0.8);
}

TEST(Pack, TwoPagesJustOverOneAreNotHalfEmpty) {
  const std::vector<RectSize> sizes(40, RectSize{98, 98});
  PackOptions options;
  options.maxPageSize = 600;  // 36 a page
  const Packing packing = packRectangles(sizes, options);
  expectDisjoint(sizes, packing, 1);
  EXPECT_EQ(packing.pageCount, 2);
  EXPECT_GT(fill(sizes, packing, 1), 0.75);
}

TEST(Pack, HundredsOfThousandsOfChartsPackWell) {
  const std::vector<RectSize> sizes = chartLike(300'000, 60);
  const Packing packing = packRectangles(sizes, {});
  expectDisjoint(sizes, packing, 1);
  EXPECT_GT(fill(sizes, packing, 1), 0.95);
}

TEST(Pack, OneRectangleMayNeedALargerPage) {
  PackOptions options;
  options.maxPageSize = 64;
  const std::vector<RectSize> sizes{{200, 10}, {3, 3}, {10, 90}, {50, 50}};
  const Packing packing = packRectangles(sizes, options);
  expectDisjoint(sizes, packing, 1);
  EXPECT_GE(packing.pageWidth, 202);
  EXPECT_LE(packing.pageWidth, 204);
}

TEST(Pack, ASinglePageGrowsBeyondTheLargestUpToTheLimit) {
  PackOptions options;
  options.maxPageSize = 64;
  options.singlePage = true;
  options.hardLimit = 512;
  std::vector<RectSize> sizes(100, RectSize{30, 30});
  const Packing packing = packRectangles(sizes, options);
  expectDisjoint(sizes, packing, 1);
  EXPECT_EQ(packing.pageCount, 1);
  sizes.assign(100, RectSize{60, 60});
  EXPECT_THROW(packRectangles(sizes, options), Error);
}

TEST(Pack, ARectangleBeyondTheLimitIsRefused) {
  PackOptions options;
  options.hardLimit = 100;
  EXPECT_NO_THROW(packRectangles({{98, 1}}, options));
  try {
    packRectangles({{99, 1}}, options);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::outOfResource);
  }
}

TEST(Pack, IsTheSameEachTime) {
  const std::vector<RectSize> sizes = chartLike(5000, 80);
  const Packing a = packRectangles(sizes, {}), b = packRectangles(sizes, {});
  EXPECT_TRUE(
      std::equal(a.places.begin(), a.places.end(), b.places.begin(),
                 [](const Placement& p, const Placement& q) { return p.page == q.page && p.x == q.x && p.y == q.y; }));
}

TEST(Pack, OfNothingIsNoPage) { EXPECT_EQ(packRectangles({}, {}).pageCount, 0); }

}  // namespace
}  // namespace lucarne::test::pack_test
