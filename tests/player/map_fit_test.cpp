#include "player/map_fit.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "player/coarser_directions.h"
#include "player/map_tables.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::map_fit_test {
namespace {

constexpr TextureLimits kLimits{4096, 2048};

TEST(MapFit, FewerDirectionsKeepTheirSum) {
  const test::BakedScene room = test::furnishedRoom(40);
  const LightMaps fewer = withFewerDirections(room.maps, 9);
  EXPECT_EQ(fewer.directionCount, 9);
  ASSERT_EQ(fewer.sides.size(), room.maps.sides.size());
  for (std::size_t s = 0; s < fewer.sides.size(); ++s) {
    const SideMaps &a = room.maps.sides[s], &b = fewer.sides[s];
    EXPECT_LE(b.directions.size(), a.directions.size());
    EXPECT_EQ(b.directions.empty(), a.directions.empty());
    const auto sum = [](const LightMaps& maps, const SideMaps& side, std::uint64_t texel) {
      Rgb total{};
      for (const SideDirection& d : side.directions) {
        if (d.stored()) total += maps.directional[d.first + texel];
      }
      return total;
    };
    for (std::uint64_t t = 0; a.lit && t < a.texelCount(); ++t) {
      const Rgb before = sum(room.maps, a, t), after = sum(fewer, b, t);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c], before[c], 1e-5f * before[c]);
    }
    for (std::size_t k = 1; k < b.directions.size(); ++k) EXPECT_LT(b.directions[k - 1].psi, b.directions[k].psi);
  }
  layOutMaps(fewer, DirectionSet(9), kLimits);  // consistent
}

TEST(MapFit, TakesASmallerFormatBeforeFewerDirections) {
  const LightMaps maps = test::furnishedRoom(40).maps;
  const auto bytes = [&](LightMapFormat format) { return mapTextureBytes(maps, format, kLimits); };
  EXPECT_TRUE(fitMaps(maps, LightMapFormat::float32, 0, kLimits).note.empty());
  EXPECT_TRUE(fitMaps(maps, LightMapFormat::float32, bytes(LightMapFormat::float32), kLimits).note.empty());
  const MapFit half = fitMaps(maps, LightMapFormat::float32, bytes(LightMapFormat::half), kLimits);
  EXPECT_EQ(half.format, LightMapFormat::half);
  EXPECT_FALSE(half.fewer);
  EXPECT_NE(half.note.find("as half"), std::string::npos) << half.note;
  const MapFit shared = fitMaps(maps, LightMapFormat::float32, bytes(LightMapFormat::rgb9e5), kLimits);
  EXPECT_EQ(shared.format, LightMapFormat::rgb9e5);
  EXPECT_FALSE(shared.fewer);
  const MapFit few = fitMaps(maps, LightMapFormat::half, bytes(LightMapFormat::rgb9e5) - 1, kLimits);
  ASSERT_TRUE(few.fewer);
  EXPECT_LE(few.fewer->directionCount, 20);
  EXPECT_LT(mapTextureBytes(*few.fewer, few.format, kLimits), bytes(LightMapFormat::rgb9e5));
  EXPECT_NE(few.note.find(" of 40 directions"), std::string::npos) << few.note;
}

TEST(MapFit, TooLittleForOneDirectionIsAnErrorOfResources) {
  try {
    fitMaps(test::furnishedRoom(5).maps, LightMapFormat::half, 100, kLimits);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::outOfResource);
  }
}

}  // namespace
}  // namespace lucarne::map_fit_test
