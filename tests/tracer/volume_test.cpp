#include "tracer/optics/volume.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lucarne::volume_test {
namespace {

Material medium(Rgb color, double distance) {
  Material m;
  m.attenuationColor = color;
  m.attenuationDistance = distance;
  return m;
}

TEST(Volume, LightFadesByBeersLaw) {
  const Rgb color{0.9f, 0.5f, 0.01f};
  for (const double distance : {0.002, 0.3, 40.0})
    for (const double metres : {1e-6, 0.001, 0.1, 1.0, 7.0}) {
      const Rgb t = transmittance(medium(color, distance), metres);
      for (int i = 0; i < 3; ++i) {
        const double expected = std::pow(static_cast<double>(color[i]), metres / distance);
        EXPECT_NEAR(static_cast<double>(t[i]), expected, 1e-6 * expected + 1e-37) << metres << " of " << distance;
      }
    }
}

TEST(Volume, TheNamedColourIsLeftAfterTheNamedDistance) {
  const Rgb color{0.25f, 0.5f, 1.f}, t = transmittance(medium(color, 0.37), 0.37);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(t[i], color[i], 1e-6f);
}

TEST(Volume, TwoWaysInARowFadeAsTheirSum) {
  const Attenuation a(medium({0.7f, 0.2f, 0.05f}, 0.5));
  const Rgb parts = a.over(0.3) * a.over(0.9), whole = a.over(1.2);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(parts[i], whole[i], 1e-6f * whole[i]);
}

TEST(Volume, AMediumWithoutDistanceIsClear) {
  EXPECT_TRUE(Attenuation(medium(Rgb{0.f}, 0)).clear());
  EXPECT_EQ(transmittance(medium({0.1f, 0.f, 0.5f}, 0), 1e6), Rgb{1.f});
  EXPECT_EQ(transmittance(medium(Rgb{1.f}, 2), 1e6), Rgb{1.f});
}

TEST(Volume, BlackIsBlackAfterAnyWayAndNotBefore) {
  const Attenuation a(medium({0.f, 0.5f, 1.f}, 1));
  EXPECT_EQ(a.over(0), Rgb{1.f});
  EXPECT_EQ(a.over(-1), Rgb{1.f});
  EXPECT_EQ(a.over(1e-12).x, 0.f);
  EXPECT_EQ(a.over(1e30), (Rgb{0.f, 0.f, 1.f}));
}

}  // namespace
}  // namespace lucarne::volume_test
