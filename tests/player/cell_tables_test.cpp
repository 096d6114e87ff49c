#include "player/cell_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lucarne::cell_tables_test {
namespace {

std::vector<Vec3d> normalsAround(int count) {
  std::vector<Vec3d> normals;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, s = std::sqrt(1 - z * z), phi = 2.399963229728653 * i;
    normals.push_back({s * std::cos(phi), s * std::sin(phi), z});
  }
  return normals;
}

TEST(CellTable, OctahedralMapIsItsOwnInverse) {
  for (const Vec3d& n : normalsAround(500)) EXPECT_LT(length(octahedralNormal(octahedralPoint(n)) - n), 1e-12);
}

TEST(CellTable, IsExactOnTheAxes) {
  const DirectionSet set(14);
  const CellTable table(set, 2048);
  for (int axis = 0; axis < 6; ++axis) {
    Vec3d n{};
    n[axis / 2] = axis % 2 ? 1 : -1;
    for (int psi = 0; psi < set.count(); ++psi) {
      const LobeCell exact = lobeCell(set, psi, n), read = table.lookUp(psi, Vec3f(n));
      EXPECT_NEAR(read.cosIntegral, exact.cosIntegral, 1e-6f);
      EXPECT_LT(length(read.direction - exact.direction), 1e-6f);
    }
  }
}

TEST(CellTable, CosineIntegralsSumToPiAtEveryNormal) {
  for (const int count : {1, 2, 14, 64, 256}) {
    const DirectionSet set(count);
    const CellTable table(set, 2048);
    for (const Vec3d& n : normalsAround(50)) {
      double exact = 0, read = 0;
      for (int psi = 0; psi < count; ++psi) {
        exact += lobeCell(set, psi, n).cosIntegral;
        read += table.lookUp(psi, Vec3f(n)).cosIntegral;
      }
      EXPECT_NEAR(exact, std::numbers::pi, 1e-5);
      EXPECT_NEAR(read, std::numbers::pi, 1e-5) << count;  // the sum is π at every node, so also between
    }
  }
}

TEST(CellTable, BetweenNodesErrsByLittle) {
  const DirectionSet set(32);
  const CellTable table(set, 2048);
  for (const Vec3d& n : normalsAround(200)) {
    for (int psi = 0; psi < set.count(); ++psi) {
      const LobeCell exact = lobeCell(set, psi, n), read = table.lookUp(psi, Vec3f(n));
      EXPECT_NEAR(read.cosIntegral, exact.cosIntegral, 0.01f * 4 * std::numbers::pi_v<float> / 32);
    }
  }
}

TEST(CellTable, TilesHoldWhatLayersCannot) {
  const DirectionSet set(14);
  const CellTable whole(set, 2048), tiled(set, 4);
  EXPECT_EQ(tiled.layers(), 4);
  EXPECT_EQ(tiled.tiles(), 4);
  for (const Vec3d& n : normalsAround(20)) {
    for (int psi = 0; psi < 14; ++psi) {
      EXPECT_EQ(whole.lookUp(psi, Vec3f(n)).cosIntegral, tiled.lookUp(psi, Vec3f(n)).cosIntegral);
    }
  }
}

TEST(CellTable, ACellBelowTheHorizonKeepsItsDirectionAndCountsNothing) {
  const DirectionSet set(64);
  int below = 0;
  for (int psi = 0; psi < set.count(); ++psi) {
    if (set.reaches(psi, {0, 0, 1})) continue;
    const LobeCell cell = lobeCell(set, psi, {0, 0, 1});
    EXPECT_EQ(cell.cosIntegral, 0.f);
    EXPECT_EQ(cell.direction, Vec3f(set.direction(psi)));
    ++below;
  }
  EXPECT_GT(below, 10);
}

}  // namespace
}  // namespace lucarne::cell_tables_test
