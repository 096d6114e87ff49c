// The window's picture against its twin on the processor, and the filter of edges.
#include "player/display_pass.h"

#include <cmath>

#include "player/read_back.h"
#include "tests/player/gl_available.h"

namespace lucarne::display_pass_test {
namespace {

constexpr int kWidth = 64, kHeight = 48;

class Display : public test::GlTest {};

/// Codes of what is shown, top row first.
std::vector<std::uint8_t> shown(const ImageRgb& image, const DisplayStyle& style) {
  FrameTarget frame(image.width, image.height, true);
  std::vector<Rgb> flipped;
  for (int y = image.height; y-- > 0;) {
    const auto row = image.pixels.begin() + y * image.width;
    flipped.insert(flipped.end(), row, row + image.width);
  }
  glTextureSubImage2D(frame.color.get(), 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT, flipped.data());
  FrameTarget window(image.width, image.height, true);
  DisplayPass display;
  display.show(frame, style, image.width, image.height, window.shading.get());
  std::vector<std::uint8_t> bytes;
  for (const Rgb& p : readBack(window).pixels) {
    for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * p[c])));
  }
  return bytes;
}

/// From dark to bright, each row another colour.
ImageRgb ramp() {
  ImageRgb image{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float v = std::exp2(static_cast<float>(x - 40) / 8);
      image.pixels.push_back({v, v * static_cast<float>(y) / kHeight, v * 0.5f});
    }
  }
  return image;
}

int worstDifference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  int worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(int{a[i]} - int{b[i]}));
  return worst;
}

TEST_F(Display, TheWindowShowsWhatPicturesShow) {
  const HeadlessGl gl;
  const ImageRgb image = ramp();
  for (const ToneCurve curve : {ToneCurve::filmic, ToneCurve::plain}) {
    const float exposure = 1.7f;
    EXPECT_LE(worstDifference(shown(image, {ViewScale::light, curve, exposure}), toDisplay(image, exposure, curve)), 1);
  }
  EXPECT_LE(worstDifference(shown(image, {ViewScale::colour}), displayImage(image, ViewScale::colour, {}).bytes), 1);
  const DisplayStyle numbers{ViewScale::number, ToneCurve::filmic, 1 / heatTop(image)};
  EXPECT_LE(worstDifference(shown(image, numbers), displayImage(image, ViewScale::number, {}).bytes), 1);
  EXPECT_EQ(gl.messages().errors, 0u) << gl.messages().first;
}

TEST_F(Display, TheOtherPictureIsRightOfTheDivider) {
  const HeadlessGl gl;
  const ImageRgb black{kWidth, kHeight, std::vector<Rgb>(static_cast<std::size_t>(kWidth * kHeight))};
  const FrameTarget white(kWidth, kHeight, true);
  constexpr GLfloat kWhite[] = {9, 9, 9, 1};
  glClearNamedFramebufferfv(white.shading.get(), GL_COLOR, 0, kWhite);
  DisplayStyle style;
  style.curve = ToneCurve::plain;
  style.other = white.color.get();
  style.divider = 0.25f;
  const auto bytes = shown(black, style);
  for (int x = 0; x < kWidth; ++x) {
    if (std::abs(x - kWidth / 4) <= 2) continue;  // the line
    EXPECT_EQ(bytes[static_cast<std::size_t>(3 * (10 * kWidth + x))], x > kWidth / 4 ? 255 : 0) << x;
  }
}

TEST_F(Display, SmoothingSoftensStairsAndLeavesEvenPlacesAlone) {
  const HeadlessGl gl;
  ImageRgb edge{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) edge.pixels.push_back(Rgb(x > 20 + y / 3 ? 1.f : 0.f));
  }
  DisplayStyle style;
  style.curve = ToneCurve::plain;
  const auto hard = shown(edge, style);
  style.smoothEdges = true;
  const auto soft = shown(edge, style);
  int between = 0;
  for (int y = 2; y < kHeight - 2; ++y) {
    for (int x = 2; x < kWidth - 2; ++x) {
      const auto i = static_cast<std::size_t>(3 * (y * kWidth + x));
      const bool nearEdge = std::abs(x - (20 + y / 3)) < 4;
      if (nearEdge) {
        between += soft[i] > 5 && soft[i] < 250 ? 1 : 0;
      } else {
        EXPECT_EQ(soft[i], hard[i]);
      }
    }
  }
  EXPECT_GT(between, kHeight / 2);
  const ImageRgb even{kWidth, kHeight, std::vector<Rgb>(static_cast<std::size_t>(kWidth * kHeight), Rgb(0.3f))};
  const auto still = shown(even, style);
  style.smoothEdges = false;
  EXPECT_LE(worstDifference(still, shown(even, style)), 1);
}

TEST_F(Display, MeteringIsThatOfTheWholePicture) {
  const HeadlessGl gl;
  const DisplayPass display;
  const FrameTarget frame(640, 360, true);
  constexpr GLfloat kGrey[] = {5, 5, 5, 1};
  glClearNamedFramebufferfv(frame.shading.get(), GL_COLOR, 0, kGrey);
  EXPECT_NEAR(display.meter(frame, ViewScale::light), 0.18f / 5, 1e-4f);
  EXPECT_NEAR(display.meter(frame, ViewScale::number), 1.f / 5, 1e-5f);
}

}  // namespace
}  // namespace lucarne::display_pass_test
