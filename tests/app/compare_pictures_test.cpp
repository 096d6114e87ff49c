#include <gtest/gtest.h>

#include <cmath>

#include "app/compare.h"
#include "base/image_file.h"
#include "base/math.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::compare_pictures_test {
namespace {

/// `action` must fail with `code` and say `words`.
template <class Action>
void expectError(Action action, ExitCode code, const std::string& words) {
  const std::string text = errorOf(code, action);
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

ImageRgb ramp(int width, int height, float scale) {
  ImageRgb image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.pixels.push_back(Rgb{1.f, 2.f, 3.f} * (scale * static_cast<float>(1 + i)));
  return image;
}

class ComparePictures : public testing::Test {
 protected:
  nlohmann::json compared(const ImageRgb& a, const ImageRgb& b) {
    writeExrRgb(folder_ / "a.exr", a);
    writeExrRgb(folder_ / "b.exr", b);
    return compare({folder_ / "a.exr", folder_ / "b.exr", {}, 1, {}, {}, {}});
  }
  TempFolder folder_;
};

TEST_F(ComparePictures, EqualOnesDifferByNothing) {
  const auto d = compared(ramp(31, 17, 5), ramp(31, 17, 5));
  EXPECT_EQ(d["rmse"], 0.0);
  EXPECT_EQ(d["relative_error"], 0.0);
  EXPECT_EQ(d["relative_mse"], 0.0);
  EXPECT_EQ(d["largest_difference"], 0.0);
  EXPECT_EQ(d["mean_ratio"], 1.0);
  EXPECT_EQ(d["flip"]["mean"], 0.0);
}

TEST_F(ComparePictures, NumbersAreThoseOfTheDefinitions) {
  const ImageRgb a = ramp(10, 10, 1);
  ImageRgb b = a;
  for (Rgb& p : b.pixels) p = p * 1.5f;
  b.pixels[37] = {-500, 0, 0};
  double squares = 0, absolute = 0, sum = 0, relative = 0, mean = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    for (int k = 0; k < 3; ++k) mean += static_cast<double>(a.pixels[i][k]) / 300;
  }
  for (std::size_t i = 0; i < 100; ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto x = static_cast<double>(a.pixels[i][k]), d = static_cast<double>(b.pixels[i][k]) - x;
      squares += d * d, absolute += std::abs(d), sum += x;
      relative += d * d / (x * x + 1e-4 * mean * mean);
    }
  }
  const auto d = compared(a, b);
  EXPECT_NEAR(d["rmse"].get<double>(), std::sqrt(squares / 300), 1e-9);
  EXPECT_NEAR(d["relative_error"].get<double>(), absolute / sum, 1e-12);
  EXPECT_NEAR(d["relative_mse"].get<double>(), relative / 300, 1e-12);
  EXPECT_EQ(d["largest_difference"], 538.0);
  EXPECT_EQ(d["largest"]["pixel"], nlohmann::json({7, 3}));
  EXPECT_EQ(d["largest"]["b"], nlohmann::json({-500.0, 0.0, 0.0}));
}

TEST_F(ComparePictures, BlackReferencesAndBrokenPixelsAreToldNotReckonedWith) {
  const ImageRgb black{4, 4, std::vector<Rgb>(16)};
  auto d = compared(black, ramp(4, 4, 1));
  EXPECT_TRUE(d["relative_error"].is_null() && d["relative_mse"].is_null() && d["mean_ratio"].is_null());
  EXPECT_GT(d["flip"]["mean"].get<double>(), 0.5);
  ImageRgb broken = ramp(4, 4, 1);
  broken.pixels[5].y = NAN;
  broken.pixels[6].x = INFINITY;
  d = compared(ramp(4, 4, 1), broken);
  EXPECT_EQ(d["non_finite_pixels"], 2);
  EXPECT_EQ(d["rmse"], 0.0);
  EXPECT_EQ(exceededLimits(d, {{}, {}, {}, 1, 1.0, {}, {}}).size(), 1u);
  EXPECT_TRUE(exceededLimits(d, {}).empty());
}

TEST_F(ComparePictures, PngsAreComparedAsADisplayShowsThem) {
  const std::vector<std::uint8_t> black(8 * 8 * 3, 0), white(8 * 8 * 3, 255);
  writePng(folder_ / "a.png", 8, 8, black);
  writePng(folder_ / "b.png", 8, 8, white);
  const auto d = compare({folder_ / "a.png", folder_ / "b.png", folder_ / "d.png", 1, {}, {}, {}});
  EXPECT_EQ(d["rmse"], 1.0);
  EXPECT_EQ(d["flip"]["kind"], "LDR");
  EXPECT_NEAR(d["flip"]["mean"].get<double>(), 0.9673, 0.001);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "d.png"));
}

TEST_F(ComparePictures, LimitsSayWhatIsAboveThem) {
  const auto d = compared(ramp(10, 10, 1), ramp(10, 10, 2));
  EXPECT_TRUE(exceededLimits(d, {{}, {}, {}, 1, 1e6, 1.1, 1.0}).empty());
  const auto all = exceededLimits(d, {{}, {}, {}, 1, 0.1, 0.5, 0.01});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_NE(all[1].find("relative error 1 is above 0.5"), std::string::npos) << all[1];
}

TEST_F(ComparePictures, RefusesWhatCannotBeCompared) {
  writeExrRgb(folder_ / "a.exr", ramp(10, 10, 1));
  writeExrRgb(folder_ / "small.exr", ramp(10, 9, 1));
  writePng(folder_ / "a.png", 10, 10, std::vector<std::uint8_t>(300));
  const auto pair = [&](const char* a, const char* b) {
    return CompareOptions{folder_ / a, folder_ / b, {}, 1, {}, {}, {}};
  };
  expectError([&] { compare(pair("a.exr", "small.exr")); }, ExitCode::badInput, "small.exr has 10x9");
  expectError([&] { compare(pair("a.exr", "none.exr")); }, ExitCode::badInput, "none.exr: no such file");
  expectError([&] { compare(pair("a.exr", "a.png")); }, ExitCode::usage, "holds linear light");
  expectError([&] { compare({folder_ / "a.exr", folder_.path(), {}, 1, {}, {}, {}}); }, ExitCode::usage, "one of each");
}

}  // namespace
}  // namespace lucarne::compare_pictures_test
