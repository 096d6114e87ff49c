#include "dlm/edge_overlaps.h"

#include <gtest/gtest.h>
#include <time.h>

#include <cmath>
#include <random>

namespace lucarne::test::edge_overlaps_test {
namespace {

constexpr double kTolerance = 1e-6;

std::vector<EdgeOverlap> overlapsOf(const std::vector<Segment>& edges, const std::vector<Segment>& others = {}) {
  return findEdgeOverlaps(edges, others, kTolerance);
}

/// Along x from `from` to `to`; runs back where to < from.
Segment along(double from, double to, double y = 0) { return {{from, y, 0}, {to, y, 0}}; }

double lengthOf(const std::vector<Segment>& edges, const EdgeOverlap& o) {
  return (o.aEnd - o.aBegin) * length(edges[o.a].to - edges[o.a].from);
}

/// One edge of length 1 and `n` that divide it, in another order; off the axes.
std::vector<Segment> longAndShort(int n) {
  const Vec3d from{-0.31, 0.12, 0.4}, to = from + normalize(Vec3d{0.3, 0.5, -0.7});
  const Segment whole{from, to};
  std::vector<Segment> edges = {whole};
  for (int i = 0; i < n; ++i) {
    const int k = static_cast<int>((static_cast<long long>(i) * 7919) % n);
    edges.push_back({Vec3d(Vec3f(whole.at((k + 1.0) / n))), Vec3d(Vec3f(whole.at(k * 1.0 / n)))});
  }
  return edges;
}

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double secondsFor(const std::vector<Segment>& edges) {
  double least = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double start = cpuSeconds();
    overlapsOf(edges);
    least = std::min(least, cpuSeconds() - start);
  }
  return least;
}

TEST(EdgeOverlaps, OfOneEdgeAlongThreeAreThree) {
  const auto all = overlapsOf({along(0, 3), along(1, 0), along(2, 1), along(3, 2)});
  ASSERT_EQ(all.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(all[i].a, 0u);
    EXPECT_EQ(all[i].b, i + 1);
    EXPECT_NEAR(all[i].aBegin, static_cast<double>(i) / 3, 1e-12);
    EXPECT_NEAR(all[i].aEnd, static_cast<double>(i + 1) / 3, 1e-12);
    EXPECT_NEAR(all[i].bBegin, 1, 1e-12);
    EXPECT_NEAR(all[i].bEnd, 0, 1e-12);
  }
}

TEST(EdgeOverlaps, OfShiftedEdgesAreWhereBothAre) {
  const auto all = overlapsOf({along(0, 1), along(1, 2), along(1.5, 0.5), along(2.5, 1.5)});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NEAR(all[0].aBegin, 0.5, 1e-12);
  EXPECT_NEAR(all[0].bBegin, 1, 1e-12);
  EXPECT_NEAR(all[0].bEnd, 0.5, 1e-12);
  EXPECT_EQ(all[2].b, 3u);
  EXPECT_NEAR(all[2].aBegin, 0.5, 1e-12);
  EXPECT_NEAR(all[2].bEnd, 0.5, 1e-12);
}

TEST(EdgeOverlaps, OfEdgesWhoseEndsWereRoundedAreWhole) {
  const auto all = overlapsOf({{{0, 0, 0}, {1, 0, 0}}, {{1, 1e-7, 0}, {-1e-7, 0, 2e-7}}});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].aEnd - all[0].aBegin, 1, 1e-6);
}

TEST(EdgeOverlaps, OfParallelEdgesApartAreNone) {
  EXPECT_TRUE(overlapsOf({along(0, 1), along(0.7, 0.2, 5e-4)}).empty());
  EXPECT_TRUE(overlapsOf({along(0, 1), along(0.7, 0.2, 3 * kTolerance)}).empty());
}

TEST(EdgeOverlaps, OfEdgesThatOnlyMeetOrCrossAreNone) {
  EXPECT_TRUE(overlapsOf({along(0, 1), along(1, 2)}).empty());
  EXPECT_TRUE(overlapsOf({along(0, 1), {{0.5, 0, 0}, {0.5, 1, 0}}, {{0.3, -1, 0}, {0.3, 1, 0}}}).empty());
  EXPECT_TRUE(overlapsOf({along(0, 1), {{0.5, 0, 0}, {1, 1e-3, 0}}}).empty());
}

TEST(EdgeOverlaps, DirectionsOfEdgesAreKept) {
  const auto all = overlapsOf({along(0, 2), along(0.5, 1)});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_LT(all[0].bBegin, all[0].bEnd);
}

// A third edge over part of what two share, alone or not, leaves the rest.
TEST(EdgeOverlaps, AreNoneWhereAThirdEdgeIs) {
  const auto third = overlapsOf({along(0, 2), along(2, 0.1), along(0.5, 1)});
  ASSERT_EQ(third.size(), 2u);
  EXPECT_NEAR(third[0].aEnd, 0.25, 1e-12);
  EXPECT_NEAR(third[1].aBegin, 0.5, 1e-12);
  EXPECT_EQ(overlapsOf({along(0, 3), along(1, 0), along(2, 1), along(3, 2)}, {along(0.9, 2.3)}).size(), 2u);
  EXPECT_TRUE(overlapsOf({along(0, 3), along(2, 1)}, {along(-5, 5)}).empty());
  EXPECT_EQ(overlapsOf({along(0, 3), along(2, 1)}, {{{1.5, -1, 0}, {1.5, 1, 0}}, along(-5, 5, 0.01)}).size(), 1u);
}

TEST(EdgeOverlaps, OfTwoCopiesOfAMeshAreNone) {
  std::vector<Segment> edges = {along(0, 3), along(1, 0), along(2, 1), along(3, 2)};
  edges.insert(edges.end(), edges.begin(), edges.begin() + 4);
  EXPECT_TRUE(overlapsOf(edges).empty());
}

// An end on the line that belongs to neither edge divides no overlap.
TEST(EdgeOverlaps, GoOnPastTheEndsOfOthers) {
  const auto all = overlapsOf({along(0, 2), along(1.5, 0.5), {{1, 0, 0}, {1, 1, 0}}});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].aEnd - all[0].aBegin, 0.5, 1e-12);
}

TEST(EdgeOverlaps, DoNotDependOnTheOrderOfEdges) {
  std::vector<Segment> edges = longAndShort(50);
  const auto covered = [](const std::vector<Segment>& e) {
    std::vector<std::array<double, 2>> ends;
    for (const EdgeOverlap& o : overlapsOf(e)) {
      const Vec3d p = e[o.a].at(o.aBegin), q = e[o.a].at(o.aEnd);
      ends.push_back({std::min(p.x, q.x), std::max(p.x, q.x)});
    }
    std::sort(ends.begin(), ends.end());
    return ends;
  };
  const auto first = covered(edges);
  std::shuffle(edges.begin(), edges.end(), std::mt19937(5));
  const auto second = covered(edges);
  ASSERT_EQ(first.size(), 50u);
  ASSERT_EQ(second.size(), 50u);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_NEAR(first[i][0], second[i][0], 1e-6);
    EXPECT_NEAR(first[i][1], second[i][1], 1e-6);
  }
}

TEST(EdgeOverlaps, OfALongEdgeWithManyAreFoundInNearlyLinearTime) {
  const std::vector<Segment> edges = longAndShort(20'000);
  const auto all = overlapsOf(edges);
  EXPECT_EQ(all.size(), 20'000u);
  double sum = 0;
  for (const EdgeOverlap& o : all) sum += lengthOf(edges, o);
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_LT(secondsFor(longAndShort(40'000)), 3.5 * secondsFor(edges));
}

// Each edge holds the ends of all that follow: cut at each, they would be 10⁸ pieces. Only near both ends of the
// longest are two alone.
TEST(EdgeOverlaps, OfNestedEdgesTakeNearlyLinearTime) {
  const auto nested = [](int n) {
    std::vector<Segment> edges;
    for (int i = 0; i < n; ++i) edges.push_back(along(i * 1e-4, (2 * n - i) * 1e-4));
    return edges;
  };
  EXPECT_EQ(overlapsOf(nested(10'000)).size(), 2u);
  EXPECT_LT(secondsFor(nested(20'000)), 3.5 * secondsFor(nested(10'000)));
}

TEST(EdgeOverlaps, OfNothingAndOfEdgesWithoutLengthAreNone) {
  EXPECT_TRUE(overlapsOf({}).empty());
  EXPECT_TRUE(overlapsOf({along(0, 1)}).empty());
  EXPECT_TRUE(overlapsOf({along(0, 0), along(0, 0), along(0, 1e-7), along(0, 1)}).empty());
  EXPECT_TRUE(overlapsOf({along(0, 1), along(0.5 + 4e-6, 0.5)}).empty());  // four tolerances: no direction
}

}  // namespace
}  // namespace lucarne::test::edge_overlaps_test
