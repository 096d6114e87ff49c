#include "dlm/direction_set.h"

#include <gtest/gtest.h>

#include <cstring>
#include <numbers>
#include <random>

namespace lucarne::direction_set_test {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3d randomUnit(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  return normalize(Vec3d{normal(rng), normal(rng), normal(rng)});
}

std::vector<Vec3d> testNormals() {
  std::vector<Vec3d> normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  normals.push_back(normalize(Vec3d{1, 1, 0}));
  normals.push_back(normalize(Vec3d{1, 1, 1}));
  std::mt19937_64 rng(7);
  for (int i = 0; i < 40; ++i) normals.push_back(randomUnit(rng));
  return normals;
}

int bruteForceNearest(const DirectionSet& set, Vec3f w) {
  int best = 0;
  for (int psi = 1; psi < set.count(); ++psi) {
    if (dot(Vec3f(set.direction(psi)), w) > dot(Vec3f(set.direction(best)), w)) best = psi;
  }
  return best;
}

class DirectionSets : public ::testing::TestWithParam<int> {
 protected:
  DirectionSet set{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Counts, DirectionSets, ::testing::Values(1, 2, 3, 4, 5, 13, 14, 64, 256, 1000),
                         ::testing::PrintToStringParamName());

TEST_P(DirectionSets, DirectionsAreUnitAndAsManyAsAsked) {
  ASSERT_EQ(set.count(), GetParam());
  for (const Vec3d& d : set.directions()) EXPECT_NEAR(length(d), 1, 1e-15);
}

TEST_P(DirectionSets, CellsTileTheSphere) {
  double solidAngle = 0;
  Vec3d moment{};
  for (int psi = 0; psi < set.count(); ++psi) {
    const ClippedCell cell = set.cell(psi);
    EXPECT_GT(cell.solidAngle, 0);
    solidAngle += cell.solidAngle;
    moment += cell.moment;
  }
  EXPECT_NEAR(solidAngle, 4 * kPi, 1e-10);
  EXPECT_NEAR(length(moment), 0, 1e-10);
}

TEST_P(DirectionSets, ClippedCellsTileEveryHemisphere) {
  for (const Vec3d& n : testNormals()) {
    double solidAngle = 0, cosIntegral = 0;
    Vec3d moment{};
    for (int psi = 0; psi < set.count(); ++psi) {
      const ClippedCell cell = set.clippedCell(psi, n);
      EXPECT_GE(cell.cosIntegral, 0);
      EXPECT_LE(cell.meanCosine(), 1 + 1e-12);
      solidAngle += cell.solidAngle;
      cosIntegral += cell.cosIntegral;
      moment += cell.moment;
    }
    EXPECT_NEAR(solidAngle, 2 * kPi, 1e-10);
    EXPECT_NEAR(cosIntegral, kPi, 1e-10);
    EXPECT_NEAR(length(moment - n * kPi), 0, 1e-10);
  }
}

TEST_P(DirectionSets, PartsAboveAndBelowAHorizonMakeTheCell) {
  for (const Vec3d& n : testNormals()) {
    for (int psi = 0; psi < set.count(); ++psi) {
      const ClippedCell above = set.clippedCell(psi, n), below = set.clippedCell(psi, -n), whole = set.cell(psi);
      ASSERT_NEAR(above.solidAngle + below.solidAngle, whole.solidAngle, 1e-12);
      ASSERT_NEAR(length(above.moment + below.moment - whole.moment), 0, 1e-12);
    }
  }
}

TEST_P(DirectionSets, ReachesExactlyWhereSomethingIsAbove) {
  for (const Vec3d& n : testNormals()) {
    for (int psi = 0; psi < set.count(); ++psi) {
      const ClippedCell cell = set.clippedCell(psi, n);
      ASSERT_EQ(set.reaches(psi, n), cell.solidAngle > 1e-9);
      const bool clearlyAbove = dot(set.direction(psi), n) > 1e-3;
      ASSERT_TRUE(set.reaches(psi, n) || !clearlyAbove);
    }
  }
}

TEST_P(DirectionSets, NearestAgreesWithBruteForceForRandomDirections) {
  std::mt19937_64 rng(11);
  const int samples = set.count() > 100 ? 30000 : 100000;
  for (int i = 0; i < samples; ++i) {
    const Vec3f w(randomUnit(rng));
    ASSERT_EQ(set.nearest(w), bruteForceNearest(set, w)) << w.x << " " << w.y << " " << w.z;
  }
}

TEST_P(DirectionSets, NearestAgreesWithBruteForceAtBisectorsAndGridEdges) {
  std::mt19937_64 rng(12);
  std::uniform_int_distribution<int> pick(0, set.count() - 1), grid(-64, 64);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d a = set.direction(pick(rng));
    const Vec3f near(normalize(a + randomUnit(rng) * 0.3));
    const Vec3d b = set.direction(bruteForceNearest(set, near));
    const Vec3f bisector(normalize(a + b + randomUnit(rng) * 1e-7)), quotient(normalize(a + set.direction(pick(rng))));
    const float x = static_cast<float>(grid(rng)) / 64, y = static_cast<float>(grid(rng)) / 64;
    const Vec3f edge = normalize(Vec3f{x, y, 1 - std::abs(x) - std::abs(y)});
    for (const Vec3f& w : {bisector, quotient, edge, -edge}) ASSERT_EQ(set.nearest(w), bruteForceNearest(set, w));
  }
}

TEST_P(DirectionSets, NearestAgreesWithBruteForceOnTheAxesAndAtTheDirectionsThemselves) {
  for (int i = 0; i < 27; ++i) {
    const Vec3f w = normalize(
        Vec3f(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1), static_cast<float>(i / 9 - 1)));
    EXPECT_EQ(set.nearest(w), bruteForceNearest(set, w));
  }
  for (int psi = 0; psi < set.count(); ++psi) EXPECT_EQ(set.nearest(Vec3f(set.direction(psi))), psi);
}

TEST_P(DirectionSets, IsTheSameBitsEachTime) {
  const DirectionSet again(GetParam());
  EXPECT_EQ(std::memcmp(set.directions().data(), again.directions().data(), sizeof(Vec3d) * set.directions().size()),
            0);
}

void expectQuadratureAgrees(const DirectionSet& set) {
  constexpr int kHeights = 1000, kTurns = 2000;  // midpoints of equal areas
  const Vec3d n = normalize(Vec3d{0.3, -0.5, 0.8});
  std::vector<SphericalIntegral> sums(static_cast<std::size_t>(set.count()));
  constexpr double kArea = 4 * kPi / (double{kHeights} * kTurns);
  for (int i = 0; i < kHeights; ++i) {
    const double z = 1 - (2.0 * i + 1) / kHeights, r = std::sqrt(1 - z * z);
    for (int j = 0; j < kTurns; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / kTurns;
      const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
      if (dot(w, n) <= 0) continue;
      sums[static_cast<std::size_t>(set.nearest(Vec3f(w)))] += {kArea, w * kArea};
    }
  }
  for (int psi = 0; psi < set.count(); ++psi) {
    const ClippedCell cell = set.clippedCell(psi, n);
    const SphericalIntegral& sum = sums[static_cast<std::size_t>(psi)];
    EXPECT_NEAR(cell.solidAngle, sum.solidAngle, 1e-3);
    EXPECT_NEAR(length(cell.moment - sum.moment), 0, 1e-3);
    EXPECT_NEAR(cell.cosIntegral, dot(sum.moment, n), 1e-3);
  }
}

TEST(DirectionSet, ClippedIntegralsAgreeWithQuadrature) {
  for (const int n : {1, 2, 3, 4, 5, 13, 14, 64}) {
    SCOPED_TRACE(n);
    expectQuadratureAgrees(DirectionSet(n));
  }
}

double cellRatio(const DirectionSet& set) {
  double smallest = 100, largest = 0;
  for (int psi = 0; psi < set.count(); ++psi) {
    smallest = std::min(smallest, set.cell(psi).solidAngle);
    largest = std::max(largest, set.cell(psi).solidAngle);
  }
  return largest / smallest;
}

TEST(DirectionSet, CellsAreOfNearlyEqualSize) {
  EXPECT_NEAR(cellRatio(DirectionSet(2)), 1, 1e-12);
  EXPECT_NEAR(cellRatio(DirectionSet(3)), 1, 0.05);
  EXPECT_NEAR(cellRatio(DirectionSet(4)), 1, 1e-3);
  for (int n = 5; n <= 64; ++n) EXPECT_LT(cellRatio(DirectionSet(n)), 1.35) << n;
  for (const int n : {100, 256, 512, 513, 1000, 4096}) EXPECT_LT(cellRatio(DirectionSet(n)), 1.5) << n;
}

TEST(DirectionSet, TwoDirectionsAreAntipodalAndFourATetrahedron) {
  const DirectionSet two(2), four(4);
  EXPECT_NEAR(length(two.direction(0) + two.direction(1)), 0, 1e-14);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(dot(four.direction(0), four.direction(i)), -1.0 / 3, 1e-3);
}

TEST(DirectionSet, KeepsClearOfThePlanesOfTheAxes) {
  const double clearance = std::sin(0.5 * kPi / 180);
  for (int n = 1; n <= 64; ++n) {
    const DirectionSet set(n);
    for (const Vec3d& d : set.directions()) {
      EXPECT_GT(std::min({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), clearance) << n;
    }
  }
}

// The bits of the set are part of what a part or a .dlm means; another machine must find the same.
TEST(DirectionSet, BitsAreThoseOfEveryMachine) {
  const auto fingerprint = [](int n) {
    std::uint64_t hash = 1469598103934665603ull;
    const DirectionSet set(n);
    for (const Vec3d& d : set.directions()) {
      for (int i = 0; i < 3; ++i) {
        std::uint64_t bits;
        const double component = d[i];
        std::memcpy(&bits, &component, sizeof bits);
        hash = (hash ^ bits) * 1099511628211ull;
      }
    }
    return hash;
  };
  EXPECT_EQ(fingerprint(14), 15340540441476717109u);
  EXPECT_EQ(fingerprint(64), 11923766117814176007u);
  EXPECT_EQ(fingerprint(1000), 1453595570509028296u);
}

TEST(DirectionSet, AnswersForEveryDirectionEvenNone) {
  const DirectionSet set(14);
  const float nan = std::nanf(""), inf = HUGE_VALF;
  for (const Vec3f& w : {Vec3f{}, Vec3f{nan, 0, 0}, Vec3f{inf, 1, 0}, Vec3f{-inf, inf, nan}})
    EXPECT_EQ(set.nearest(w), 0);
  for (const float scale : {1e-20f, 0.5f, 3.f, 1e18f}) {
    for (int psi = 0; psi < 14; ++psi) EXPECT_EQ(set.nearest(Vec3f(set.direction(psi)) * scale), psi);
  }
}

TEST(DirectionSet, RefusesImpossibleCounts) {
  EXPECT_THROW(DirectionSet(0), std::logic_error);
  EXPECT_THROW(DirectionSet(-1), std::logic_error);
  EXPECT_THROW(DirectionSet(65536), std::logic_error);
}

}  // namespace
}  // namespace lucarne::direction_set_test
