// Pictures against stored ones, as a person would tell them apart.
//
// Drivers round differently, so FLIP judges, not bytes. After a wanted change run the tests with
// LUCARNE_UPDATE_REFERENCES=1 and look at the new pictures before they are committed.
#include <cstdlib>
#include <filesystem>

#include "base/files.h"
#include "base/flip.h"
#include "base/heat_colour.h"
#include "base/math.h"
#include "player/display_image.h"
#include "player/offscreen.h"
#include "tests/player/gl_available.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::reference_test {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 120;

struct Shot {
  const char* name;
  View view{};
  RendererKind renderer = RendererKind::singlepass;
};

class Reference : public test::GlTest, public ::testing::WithParamInterface<Shot> {};

/// Linear RGB of display codes, as FLIP wants it.
ImageRgb linear(int width, int height, const std::uint8_t* codes, int stride) {
  ImageRgb image{width, height, {}};
  for (int i = 0; i < width * height; ++i, codes += stride) {
    image.pixels.push_back({srgbToLinear(codes[0]), srgbToLinear(codes[1]), srgbToLinear(codes[2])});
  }
  return image;
}

void writeHeat(const fs::path& path, const FlipMap& map) {
  std::vector<std::uint8_t> bytes;
  for (const float e : map.error) {
    const auto colour = heatColour(static_cast<double>(e));
    bytes.insert(bytes.end(), colour.begin(), colour.end());
  }
  writePng(path, map.width, map.height, bytes);
}

TEST_P(Reference, LooksLikeTheStoredPicture) {
  const Shot& shot = GetParam();
  const test::BakedScene baked = test::furnishedRoom(14);
  RenderOptions options{kWidth, kHeight, shot.renderer, LightMapFormat::half};
  options.view = shot.view;
  options.supersamples = 2;
  const ImageRgb image = renderImage(baked.scene, baked.maps, baked.scene.cameras.at(0), options);
  const DisplayedImage shown = displayImage(image, scaleOf(shot.view.kind), {});
  const fs::path stored = fs::path(LUCARNE_SOURCE_DIR "/tests/player/reference") / (std::string(shot.name) + ".png");
  if (std::getenv("LUCARNE_UPDATE_REFERENCES") != nullptr) writePng(stored, kWidth, kHeight, shown.bytes);
  const DecodedImage reference = decodeImage(readFile(stored), stored.string());
  ASSERT_EQ(reference.width, kWidth);
  ASSERT_EQ(reference.height, kHeight);
  const FlipMap flip =
      flipLdr(linear(kWidth, kHeight, reference.rgba.data(), 4), linear(kWidth, kHeight, shown.bytes.data(), 3));
  EXPECT_LT(flip.mean(), 0.01) << shot.name;
  if (flip.mean() < 0.01) return;
  const fs::path base = fs::temp_directory_path() / ("lucarne-reference-" + std::string(shot.name));
  writePng(base.string() + ".png", kWidth, kHeight, shown.bytes);
  writeHeat(base.string() + "-difference.png", flip);
  ADD_FAILURE() << "the picture and its difference are " << base.string() << ".png and -difference.png";
}

INSTANTIATE_TEST_SUITE_P(Shots, Reference,
                         ::testing::Values(Shot{"full"}, Shot{"multipass", {}, RendererKind::multipass},
                                           Shot{"irradiance", {ViewKind::irradiance}},
                                           Shot{"direction", {ViewKind::direction, 3}},
                                           Shot{"charts", {ViewKind::charts}},
                                           Shot{"wireframe", {ViewKind::wireframe}}),
                         [](const auto& shot) { return std::string(shot.param.name); });

// A test of the tester: another picture is not taken for the stored one.
TEST(ReferenceOfReferences, FlipTellsABrighterPictureApart) {
  const ImageRgb dark{64, 64, std::vector<Rgb>(4096, Rgb(0.2f))}, bright{64, 64, std::vector<Rgb>(4096, Rgb(0.22f))};
  EXPECT_GT(flipLdr(dark, bright).mean(), 0.01);
}

}  // namespace
}  // namespace lucarne::reference_test
