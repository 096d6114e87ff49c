#include "player/segment_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace lucarne::segment_triangle_test {
namespace {

using Triangle3 = std::array<Vec3d, 3>;

Vec3d randomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> u(-1, 1);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

/// The smallest distance of many points of both.
double sampledDistance(Vec3d p, Vec3d q, const Triangle3& t) {
  constexpr int n = 24;
  double best = 1e300;
  for (int k = 0; k <= n; ++k) {
    const Vec3d on = p + (q - p) * (static_cast<double>(k) / n);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec3d at =
            t[0] + (t[1] - t[0]) * (static_cast<double>(i) / n) + (t[2] - t[0]) * (static_cast<double>(j) / n);
        best = std::min(best, length(on - at));
      }
    }
  }
  return best;
}

TEST(SegmentTriangle, IsAsNearAsTheNearestOfManyPoints) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec3d p = randomPoint(random), q = randomPoint(random);
    const Triangle3 t{randomPoint(random), randomPoint(random), randomPoint(random)};
    const NearestPair pair = nearestPair(p, q, t);
    const double distance = std::sqrt(pair.squaredDistance), sampled = sampledDistance(p, q, t);
    EXPECT_LE(distance, sampled + 1e-9);
    EXPECT_GE(distance, sampled - 0.15);  // of the grid's width
    EXPECT_NEAR(length(pair.onSegment - pair.onTriangle), distance, 1e-12);
  }
}

TEST(SegmentTriangle, WhatCrossesIsAtNoDistance) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0.05, 1);
  for (int i = 0; i < 300; ++i) {
    const Triangle3 t{randomPoint(random), randomPoint(random), randomPoint(random)};
    const double a = u(random), b = u(random), c = u(random);
    const Vec3d inside = (t[0] * a + t[1] * b + t[2] * c) / (a + b + c), way = randomPoint(random);
    EXPECT_NEAR(nearestPair(inside - way, inside + way * u(random), t).squaredDistance, 0, 1e-20);
  }
}

TEST(SegmentTriangle, WithoutExtentIsAPointOrALine) {
  const Vec3d up{0, 1, 0};
  const Triangle3 point{Vec3d{2, 0.5, 0}, Vec3d{2, 0.5, 0}, Vec3d{2, 0.5, 0}};
  EXPECT_DOUBLE_EQ(nearestPair({}, up, point).squaredDistance, 4);
  const Triangle3 line{Vec3d{1, 0.5, -1}, Vec3d{1, 0.5, 1}, Vec3d{1, 0.5, 0}};
  EXPECT_DOUBLE_EQ(nearestPair({}, up, line).squaredDistance, 1);
  const Triangle3 ground{Vec3d{-9, -1, -9}, Vec3d{9, -1, -9}, Vec3d{0, -1, 9}};
  EXPECT_DOUBLE_EQ(nearestPair({}, {}, ground).squaredDistance, 1);
}

}  // namespace
}  // namespace lucarne::segment_triangle_test
