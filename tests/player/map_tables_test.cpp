#include "player/map_tables.h"

#include <gtest/gtest.h>

#include "tests/player/synthetic_maps.h"

namespace lucarne::map_tables_test {
namespace {

class MapTablesTest : public ::testing::TestWithParam<int> {};

TEST_P(MapTablesTest, MembersAreFoundByTheirBits) {
  const test::BakedScene baked = test::furnishedRoom(GetParam());
  const MapTables t = layOutMaps(baked.maps, DirectionSet(GetParam()), {16384, 2048});
  ASSERT_EQ(t.sides.size(), baked.maps.sides.size() + 1);
  EXPECT_EQ(t.sides[0].flags, 0u);
  for (std::size_t i = 0; i < baked.maps.sides.size(); ++i) {
    const SideMaps& side = baked.maps.sides[i];
    if (!side.lit) continue;
    std::uint32_t stored = 0, empty = 0;
    for (const SideDirection& d : side.directions) {
      const GpuMemberBits& word = t.memberBits[(i + 1) * static_cast<std::size_t>(t.wordsPerSide) + d.psi / 32];
      const std::uint32_t bit = 1u << (d.psi % 32), before = bit - 1;
      const auto count = [&](std::uint32_t bits) {
        return static_cast<std::uint32_t>(__builtin_popcount(bits & before));
      };
      EXPECT_EQ((word.stored & bit) != 0, d.stored());
      EXPECT_EQ((word.empty & bit) != 0, !d.stored());
      if (d.stored()) {
        EXPECT_EQ(word.storedBefore + count(word.stored), stored++);
      } else {
        EXPECT_EQ(word.emptyBefore + count(word.empty), empty++);
      }
    }
    EXPECT_EQ(t.sides[i + 1].stored, stored);
    EXPECT_EQ(t.sides[i + 1].members, stored + empty);
  }
}

TEST_P(MapTablesTest, PlanarSidesListTheirExactCells) {
  const test::BakedScene baked = test::furnishedRoom(GetParam());
  const DirectionSet set(GetParam());
  const MapTables t = layOutMaps(baked.maps, set, {16384, 2048});
  for (std::size_t i = 0; i < baked.maps.sides.size(); ++i) {
    const SideMaps& side = baked.maps.sides[i];
    const MapChart& chart = baked.maps.charts[side.chart];
    if (!side.lit || needsCellTable(chart)) continue;
    std::uint32_t rank = 0;
    for (const bool stored : {true, false}) {
      for (const SideDirection& d : side.directions) {
        if (d.stored() != stored) continue;
        const LobeTexel cell = t.cells[t.sides[i + 1].firstCell + rank++];
        EXPECT_NEAR(cell.c, lobeCell(set, d.psi, Vec3d(side.back ? -chart.normal : chart.normal)).cosIntegral, 1e-6f);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, MapTablesTest, ::testing::Values(1, 14, 100));

TEST(MapTables, IndicesOutOfRangeAreABrokenContract) {
  const DirectionSet set(14);
  const test::BakedScene baked = test::furnishedRoom(14);
  LightMaps maps = baked.maps;
  maps.sides[0].chart = 1000;
  EXPECT_THROW(layOutMaps(maps, set, {16384, 2048}), std::logic_error);
  maps = baked.maps;
  maps.sides[0].directions[0].first = maps.directional.size() - 1;
  EXPECT_THROW(layOutMaps(maps, set, {16384, 2048}), std::logic_error);
  maps = baked.maps;
  maps.sides[0].directions[0].psi = 14;
  EXPECT_THROW(layOutMaps(maps, set, {16384, 2048}), std::logic_error);
}

}  // namespace
}  // namespace lucarne::map_tables_test
