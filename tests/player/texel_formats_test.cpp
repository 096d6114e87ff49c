#include "player/texel_formats.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace lucarne::texel_formats_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

TEST(TexelFormats, SharedExponentKeepsTheLargestComponentToHalfAStep) {
  for (int i = 0; i < 4000; ++i) {
    const Rgb v =
        Rgb{1.f, 0.37f, 0.011f} * std::exp2(static_cast<float>(i % 28) - 13.f) * (1.f + static_cast<float>(i) / 4000.f);
    const Rgb back = unpackRgb9e5(packRgb9e5(v));
    const float step = v.x / 256.f;  // mantissas of the largest lie in 256 … 511
    for (int c = 0; c < 3; ++c) EXPECT_LE(std::abs(back[c] - v[c]), 0.5001f * step) << i;
  }
}

TEST(TexelFormats, SharedExponentHasNoBias) {
  double sum = 0, back = 0;
  for (int i = 1; i <= 20000; ++i) {
    const float v = static_cast<float>(i) * 0.00731f;
    sum += v;
    back += unpackRgb9e5(packRgb9e5(Rgb(v))).x;
  }
  EXPECT_NEAR(back / sum, 1, 2e-5);
}

TEST(TexelFormats, SharedExponentClampsWhatItCannotHold) {
  EXPECT_EQ(packRgb9e5({0, -1, kNaN}), 0u);
  EXPECT_EQ(unpackRgb9e5(packRgb9e5({kInf, 0, 1e9f})), (Rgb{65408.f, 0, 65408.f}));
  EXPECT_EQ(unpackRgb9e5(packRgb9e5({65408.f, 0, 0})).x, 65408.f);
}

TEST(TexelFormats, HalfRoundsToNearest) {
  for (int i = 1; i < 5000; ++i) {
    const float v = static_cast<float>(i) * 1.2345f;
    EXPECT_LE(std::abs(glm::unpackHalf1x16(packHalf(v)) - v), v / 2048.f);
  }
  EXPECT_EQ(packHalf(kNaN), 0);
}

TEST(TexelFormats, ScaleIsAPowerOfTwoThatFitsHalf) {
  for (const float v : {1e-33f, 1e-12f, 0.3f, 1.f, 32768.f, 65504.f, 1e9f, 3e38f}) {
    const float scale = halfScale(v);
    int exponent = 0;
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5f);
    EXPECT_LE(v * scale, 32768.f) << v;
    EXPECT_GE(v * scale, 16384.f) << v;
  }
  for (const float v : {0.f, -1.f, kNaN, kInf}) EXPECT_EQ(halfScale(v), 1.f);
}

}  // namespace
}  // namespace lucarne::texel_formats_test
