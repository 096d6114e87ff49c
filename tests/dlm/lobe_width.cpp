#include "dlm/lobe_width.h"

#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"
#include "tracer/optics/phong.h"

namespace lucarne::lobe_width_test {
namespace {

Material coat(float exponent) {
  Material m = test::diffuseMaterial(Rgb(0.2f));
  m.name = "coat";
  m.specular = 1;
  m.roughness = roughnessFromPhong(exponent);
  return m;
}

/// One chart a material, each with directions but the last.
LightMaps mapsOf(std::size_t materials, int directions) {
  LightMaps maps;
  maps.directionCount = directions;
  for (std::uint32_t m = 0; m < materials; ++m) {
    MapChart chart;
    chart.material = m;
    maps.charts.push_back(chart);
    SideMaps side;
    side.chart = m;
    side.lit = true;
    if (m + 1 < materials) side.directions.push_back({});
    maps.sides.push_back(side);
  }
  return maps;
}

TEST(LobeWidth, NamesTheMaterialsThatAreNarrowerThanACellAndWhatTheyShow) {
  Scene scene;
  scene.materials = {coat(5), coat(100), coat(1000), coat(1000)};
  const auto few = widenedHighlights(scene, mapsOf(4, 14));
  ASSERT_EQ(few.size(), 2u);  // the last has no directions
  EXPECT_EQ(few[0].material, 1u);
  EXPECT_NEAR(few[0].exponent, 100, 0.1);
  EXPECT_NEAR(few[0].shownExponent, 101 * 16.8 / (101 + 16.8) - 1, 0.01);
  EXPECT_LT(few[1].shownExponent, 16.8);
  EXPECT_TRUE(widenedHighlights(scene, mapsOf(4, 4096)).empty());
}

TEST(LobeWidth, MirrorsAreNamedWithFiniteExponents) {
  Scene scene;
  scene.materials = {coat(5), coat(5)};
  scene.materials[0].roughness = 0;
  const auto widened = widenedHighlights(scene, mapsOf(2, 1024));
  ASSERT_EQ(widened.size(), 1u);
  EXPECT_TRUE(std::isfinite(widened[0].exponent));
  EXPECT_NEAR(widened[0].shownExponent, 1.2 * 1024, 10);
}

}  // namespace
}  // namespace lucarne::lobe_width_test
