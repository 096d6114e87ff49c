// The triangles of Ω: a Delaunay triangulation, and weights that are barycentric, continuous and exact in their sum.
#include "dlm/direction_triangles.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "dlm/direction_set_cells.h"
#include "dlm/mean_direction.h"
#include "dlm/spherical_polygon.h"

namespace lucarne::direction_triangles_test {
namespace {

Vec3d randomUnit(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return normalize(Vec3d{normal(rng), normal(rng), normal(rng)});
}

class Triangulations : public ::testing::TestWithParam<int> {
 protected:
  std::vector<Vec3d> set = spreadDirections(GetParam());
  DirectionTriangles triangles{set};
  std::mt19937_64 rng{static_cast<std::uint64_t>(GetParam())};

  std::vector<double> weightsOf(Vec3f w) const {
    std::vector<double> all(set.size());
    const DirectionWeights found = triangles.around(w);
    for (std::size_t k = 0; k < 3; ++k) all[found.psi[k]] += found.weight[k] / double{DirectionWeights::kWhole};
    return all;
  }
};

// 6, 8 and 12 have circles of more than three points.
INSTANTIATE_TEST_SUITE_P(Counts, Triangulations,
                         ::testing::Values(4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 24, 32, 64, 100, 256, 513, 1000, 4096),
                         ::testing::PrintToStringParamName());

TEST_P(Triangulations, CoverTheSphereOnce) {
  double area = 0;
  for (const auto& t : triangles.triangles()) {
    const std::array<Vec3d, 3> v{set[t.psi[0]], set[t.psi[1]], set[t.psi[2]]};
    const double own = solidAngle(v);
    EXPECT_GT(own, 0);
    area += own;
  }
  EXPECT_NEAR(area, 12.566370614359172, 1e-9);
}

TEST_P(Triangulations, HoldNoOtherDirectionInTheirCircles) {
  const auto& all = triangles.triangles();
  for (std::size_t i = 0; i < all.size(); i += all.size() / 50 + 1) {
    const Vec3d a = set[all[i].psi[0]], normal = normalize(cross(set[all[i].psi[1]] - a, set[all[i].psi[2]] - a));
    for (const Vec3d& p : set) ASSERT_LE(dot(normal, p - a), 1e-12);
  }
}

TEST_P(Triangulations, NeighboursShareAnEdge) {
  const auto& all = triangles.triangles();
  for (const auto& t : all) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& o = all[t.across[k]].psi;
      for (const std::size_t end : {(k + 1) % 3, (k + 2) % 3})
        EXPECT_NE(std::find(o.begin(), o.end(), t.psi[end]), o.end());
      EXPECT_EQ(std::find(o.begin(), o.end(), t.psi[k]), o.end());
    }
  }
}

TEST_P(Triangulations, ADirectionOfTheSetIsItsOwnAlone) {
  for (std::size_t psi = 0; psi < set.size(); ++psi) EXPECT_EQ(weightsOf(Vec3f(set[psi]))[psi], 1) << psi;
}

TEST_P(Triangulations, WeightsSumToOneAndGiveTheDirectionBack) {
  for (int i = 0; i < 20'000; ++i) {
    const Vec3d w = randomUnit(rng);
    const DirectionWeights found = triangles.around(Vec3f(w));
    Vec3d sum{};
    std::uint32_t whole = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LE(found.weight[k], DirectionWeights::kWhole);
      whole += found.weight[k];
      sum += set[found.psi[k]] * (found.weight[k] / double{DirectionWeights::kWhole});
    }
    ASSERT_EQ(whole, DirectionWeights::kWhole);
    ASSERT_LT(length(cross(normalize(sum), w)), 1e-4) << i;  // also no triangle but its own would give it back
  }
}

TEST_P(Triangulations, WeightsAreContinuousAcrossEdges) {
  std::uniform_real_distribution<double> uniform;
  const auto& all = triangles.triangles();
  const double step = 1e-3 / std::sqrt(static_cast<double>(set.size()));
  for (int i = 0; i < 2000; ++i) {
    const auto& t = all[rng() % all.size()];
    const Vec3d a = set[t.psi[0]], b = set[t.psi[1]], normal = normalize(cross(a, b));
    const Vec3d on = normalize(a + (b - a) * uniform(rng));
    const std::vector<double> here = weightsOf(Vec3f(on + normal * step)), there = weightsOf(Vec3f(on - normal * step));
    for (std::size_t psi = 0; psi < set.size(); ++psi) ASSERT_NEAR(here[psi], there[psi], 0.004) << i;
  }
}

TEST_P(Triangulations, WhatSharesIsWithinTheReachOfMeanDirections) {
  const auto reach = static_cast<double>(meanReach(GetParam(), DirectionFilter::linear));
  for (const auto& t : triangles.triangles())
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(length(set[t.psi[k]] - set[t.psi[(k + 1) % 3]]), reach);
}

TEST_P(Triangulations, OfAnyLengthAndOfNone) {
  const Vec3f w(randomUnit(rng));
  for (const float scale : {1e-20f, 1e-3f, 1e3f, 1e15f})
    EXPECT_EQ(triangles.around(w * scale).psi, triangles.around(w).psi);
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3f& none : {Vec3f{}, Vec3f{kNan, 0, 1}, Vec3f{kInf, 0, 0}, Vec3f{kInf, -kInf, kNan}})
    EXPECT_EQ(triangles.around(none).weight[0], DirectionWeights::kWhole);
}

}  // namespace
}  // namespace lucarne::direction_triangles_test
