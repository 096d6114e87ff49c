#include "base/heat_colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lucarne::heat_colour_test {
namespace {

TEST(HeatColour, GrowsLighterAllTheWay) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const auto c = heatColour(i / 100.0);
    const double light = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_GT(light, before);
    before = light;
  }
  EXPECT_EQ(heatColour(-1), heatColour(0));
  EXPECT_EQ(heatColour(7), heatColour(1));
  EXPECT_EQ(heatColour(NAN), heatColour(0));
}

}  // namespace
}  // namespace lucarne::heat_colour_test
