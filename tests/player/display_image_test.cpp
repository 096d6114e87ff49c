#include "player/display_image.h"

#include <gtest/gtest.h>

#include "base/heat_colour.h"

namespace lucarne::display_image_test {
namespace {

ImageRgb row(std::vector<Rgb> pixels) { return {static_cast<int>(pixels.size()), 1, std::move(pixels)}; }

TEST(DisplayImage, AnExposureValueMakesItsRadianceWhite) {
  const double ev = 6;
  const auto white = static_cast<float>(1.2 * 64);
  const auto shown = displayImage(row({Rgb(white), Rgb(2 * white), Rgb(0.5f * white), Rgb(0.f)}), ViewScale::light,
                                  {ToneCurve::plain, ev});
  EXPECT_EQ(shown.bytes[0], 255);
  EXPECT_EQ(shown.bytes[3], 255);
  EXPECT_EQ(shown.bytes[6], 188);  // sRGB of one half
  EXPECT_EQ(shown.bytes[9], 0);
  EXPECT_NEAR(ev100OfExposure(exposureOfEv100(ev)), ev, 1e-12);
}

TEST(DisplayImage, CurvesDiffer) {
  const ImageRgb image = row({Rgb(1.f)});
  const auto bytes = [&](ToneCurve curve) { return displayImage(image, ViewScale::light, {curve, 0.0}).bytes[0]; };
  EXPECT_NE(bytes(ToneCurve::plain), bytes(ToneCurve::filmic));
}

TEST(DisplayImage, NumbersGoFromBlackToTheTopOfTheHeatColours) {
  std::vector<Rgb> pixels(1000, Rgb(2.f));
  pixels[0] = Rgb(0.f);
  pixels[1] = Rgb(1e9f);  // a single one does not stretch the scale
  pixels[2] = Rgb(1.f);
  const ImageRgb image = row(pixels);
  EXPECT_EQ(heatTop(image), 2.f);
  const DisplayedImage shown = displayImage(image, ViewScale::number, {});
  const auto colour = [&](std::size_t i) {
    return std::array{shown.bytes[3 * i], shown.bytes[3 * i + 1], shown.bytes[3 * i + 2]};
  };
  EXPECT_EQ(colour(0), heatColour(0));
  EXPECT_EQ(colour(1), heatColour(1));
  EXPECT_EQ(colour(2), heatColour(0.5));
  EXPECT_EQ(colour(3), heatColour(1));
  EXPECT_EQ(shown.scale, "black 0 to pale yellow 2");
  EXPECT_EQ(heatTop(row({Rgb(0.f)})), 1.f);
}

TEST(DisplayImage, ColoursStayAsTheyAre) {
  const auto bytes = displayImage(row({Rgb{0.f, 0.5f, 1.f}}), ViewScale::colour, {}).bytes;
  EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0, 188, 255}));
}

}  // namespace
}  // namespace lucarne::display_image_test
