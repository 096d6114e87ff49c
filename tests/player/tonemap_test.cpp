#include "player/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lucarne::tonemap_test {
namespace {

ImageRgb imageOf(std::vector<Rgb> pixels) { return {static_cast<int>(pixels.size()), 1, std::move(pixels)}; }

TEST(Tonemap, ExposureFollowsTheLightInverselyOverAllMagnitudes) {
  const ImageRgb image = imageOf({Rgb(1.f), Rgb(2.f), Rgb(4.f), Rgb(8.f)});
  const float base = autoExposure(image);
  for (const float scale : {1e-12f, 1e-3f, 1e6f, 1e12f}) {
    ImageRgb scaled = image;
    for (Rgb& p : scaled.pixels) p *= scale;
    EXPECT_NEAR(autoExposure(scaled) * scale / base, 1.f, 1e-4f);
  }
}

TEST(Tonemap, BlackAndBrokenPixelsDoNotCount) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(autoExposure(imageOf({Rgb(0.f), Rgb(0.f)})), 1.f);
  EXPECT_EQ(autoExposure(imageOf({})), 1.f);
  EXPECT_NEAR(autoExposure(imageOf({Rgb(0.f), Rgb(nan), Rgb(inf), Rgb(1.f)})), 0.18f, 1e-5f);
  const auto bytes = toDisplay(imageOf({Rgb(nan), Rgb(inf), Rgb(-1.f)}), 1.f);
  EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 0, 0, 0}));
}

TEST(Tonemap, CurveAndCodeRiseFromBlackToWhite) {
  float last = -1;
  for (int i = 0; i <= 1000; ++i) {
    const float v = encodeSrgb(filmic(static_cast<float>(i) * 0.02f));
    EXPECT_GE(v, last);
    last = v;
  }
  EXPECT_EQ(encodeSrgb(filmic(0.f)), 0.f);
  EXPECT_NEAR(encodeSrgb(0.5f), 0.735357f, 1e-5f);
  EXPECT_GT(last, 0.98f);
}

}  // namespace
}  // namespace lucarne::tonemap_test
