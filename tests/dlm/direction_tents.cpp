// Integrals of tents above a horizon: against sums over many directions, each shared as a hit is.
#include "dlm/direction_tents.h"

#include <gtest/gtest.h>

#include <numbers>

#include "dlm/direction_shares.h"

namespace lucarne::direction_tents_test {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<Vec3d> normals() {
  return {{0, 0, 1},
          {0, -1, 0},
          normalize(Vec3d{1, 1, 0}),
          normalize(Vec3d{-0.3, 0.9, 0.2}),
          normalize(Vec3d{0.1, -0.4, -0.8})};
}

class Tents : public ::testing::TestWithParam<int> {
 protected:
  DirectionSet set{GetParam(), DirectionFilter::linear};
};
INSTANTIATE_TEST_SUITE_P(Counts, Tents, ::testing::Values(4, 6, 14, 32, 64, 256), ::testing::PrintToStringParamName());

TEST_P(Tents, CoverTheHemisphereOnce) {
  for (const Members members : {Members::reaching, Members::all}) {
    for (const Vec3d& n : normals()) {
      double solidAngle = 0, cosine = 0;
      Vec3d mean{};
      for (int psi = 0; psi < set.count(); ++psi) {
        const ClippedCell tent = set.clippedCell(psi, n, members);
        solidAngle += tent.solidAngle;
        cosine += tent.cosIntegral;
        mean += set.cosineMoment(psi, n, members);
      }
      EXPECT_NEAR(solidAngle, 2 * kPi, 2e-5);
      EXPECT_NEAR(cosine, kPi, 2e-5);
      EXPECT_NEAR(length(mean - n * (2 * kPi / 3)), 0, 2e-5);
    }
  }
}

/// Sums over evenly spread directions, shared as hits are on a side whose members reach above `n`, or of all.
std::vector<TentIntegral> counted(const DirectionSet& set, Vec3d n, Members kind) {
  MemberSet m;
  for (int psi = 0; psi < set.count(); ++psi) {
    m.rank.push_back(0);
    if (kind == Members::reaching && !set.reaches(psi, n)) continue;
    m.rank.back() = static_cast<std::uint16_t>(m.members.size());
    m.members.push_back(static_cast<std::uint16_t>(psi));
  }
  std::vector<TentIntegral> sums(static_cast<std::size_t>(set.count()));
  constexpr int kPoints = 400'000;
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - (2 * i + 1.0) / kPoints, phi = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
    if (dot(w, n) <= 0) continue;
    const DirectionShares shares = directionShares(set, m, Vec3f(w));
    std::uint32_t before = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double part = 4 * kPi / kPoints * (shares.upTo[k] - before) / DirectionWeights::kWhole;
      before = shares.upTo[k];
      TentIntegral& sum = sums[m.members[shares.rank[k]]];
      sum.solidAngle += part;
      sum.moment += w * part;
      for (std::size_t row = 0; row < 3; ++row) sum.second[row] += w * (w[static_cast<int>(row)] * part);
    }
  }
  return sums;
}

TEST_P(Tents, AgreeWithHitsThatAreShared) {
  for (const Members members : {Members::reaching, Members::all}) {
    for (const Vec3d& n : normals()) {
      const std::vector<TentIntegral> expected = counted(set, n, members);
      for (int psi = 0; psi < set.count(); ++psi) {
        const TentIntegral& e = expected[static_cast<std::size_t>(psi)];
        const ClippedCell tent = set.clippedCell(psi, n, members);
        EXPECT_NEAR(tent.solidAngle, e.solidAngle, 4e-4) << psi;
        EXPECT_NEAR(tent.cosIntegral, dot(e.moment, n), 4e-4) << psi;
        EXPECT_NEAR(length(tent.moment - e.moment), 0, 6e-4) << psi;
        EXPECT_NEAR(length(set.cosineMoment(psi, n, members) - e.secondAlong(n)), 0, 6e-4) << psi;
      }
    }
  }
}

}  // namespace
}  // namespace lucarne::direction_tents_test
