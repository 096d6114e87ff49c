// What the formats of directional maps keep, and what they lose.
#include <gtest/gtest.h>

#include "base/files.h"
#include "base/image_file.h"
#include "dlm/dlm_reader.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/dlm/dlm_file_fixture.h"

namespace lucarne::map_formats_test {
namespace {

using test::BakedScene;
using test::smallBakedScene;

LightMaps reread(const BakedScene& scene, const DlmFormat& format) {
  const TempFolder folder;
  scene.write(folder / "room.dlm", format);
  return readDlm(folder / "room.dlm").maps;
}

TEST(MapFormats, SharedExponentKeepsNineBitsOfTheLargestComponentAtEveryBrightness) {
  for (const float brightness : {1e-12f, 1.f, 1e12f, 1e30f}) {
    const BakedScene scene = smallBakedScene(brightness);
    const LightMaps& before = scene.maps();
    const LightMaps after = reread(scene, {MapFormat::rgb9e5, ExrCompression::rle});
    ASSERT_EQ(before.directional.size(), after.directional.size());
    EXPECT_EQ(before.irradiance, after.irradiance);
    for (std::size_t i = 0; i < before.directional.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after.directional[i][c], before.directional[i][c], 0x1.01p-9f * maxComponent(before.directional[i]));
  }
}

TEST(MapFormats, EightBitsKeepTheRootToHalfAStepBelowTheCut) {
  for (const float brightness : {1e-12f, 1.f, 1e12f, 1e30f}) {
    const BakedScene scene = smallBakedScene(brightness);
    const LightMaps& before = scene.maps();
    const LightMaps after = reread(scene, {MapFormat::ldr8, ExrCompression::rle, 1e6});
    const LdrScales scales = ldrScales(before, 1e6);
    EXPECT_EQ(scales.cutFlux, 0);
    std::size_t stored = 0;
    for (const SideMaps& side : before.sides)
      for (const SideDirection& d : side.directions) {
        if (!d.stored()) continue;
        const float scale = scales.scales[stored++];
        for (std::size_t i = d.first; i < d.first + side.texelCount(); ++i)
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(std::sqrt(after.directional[i][c] / scale), std::sqrt(before.directional[i][c] / scale), 0.501f / 255);
      }
    EXPECT_EQ(stored, scales.scales.size());
  }
}

TEST(MapFormats, MapsWithoutColourAreOneChannelAndReadAsTheyWere) {
  BakedScene scene(14);
  scene.builder.addMaterial(test::doubleSidedMaterial());
  scene.builder.addQuad({0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}, 0);
  scene.addChart(0, {0, 1, 0}, 4, 4, 1, 1, 1);
  scene.addSide(false, [](int, int) { return Rgb(1.f); });
  scene.addDirection(2, [](int x, int y) { return Rgb(static_cast<float>(1 + x * y)); });
  scene.addDirection(3, [](int x, int y) { return Rgb(static_cast<float>(1 + x), static_cast<float>(y), 0.f); });
  scene.addDirection(5, [](int x, int) { return Rgb(static_cast<float>(x)); });
  scene.setAtlas(8, 8);
  for (const MapFormat format : {MapFormat::half, MapFormat::float32, MapFormat::rgb9e5, MapFormat::ldr8}) {
    const TempFolder folder;
    scene.write(folder / "room.dlm", {format, ExrCompression::none});
    std::size_t neutral = 0;
    for (const ExrLayer& layer : readExr(folder / "room.dlm" / "directional.exr"))
      neutral += layer.channels.size() == 1 && layer.channels[0].name == "Y";
    EXPECT_EQ(neutral, format == MapFormat::ldr8 ? 0u : 2u);
    const LightMaps after = readDlm(folder / "room.dlm").maps;
    ASSERT_EQ(after.directional.size(), scene.maps().directional.size());
    if (format != MapFormat::ldr8) {
      EXPECT_EQ(after.directional, scene.maps().directional);
    }
  }
}

TEST(MapFormats, KMaxCutsHighlightsAndSaysHowMuchFluxThatTook) {
  BakedScene scene(14);
  scene.builder.addMaterial(test::doubleSidedMaterial());
  scene.builder.addQuad({0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}, 0);
  scene.addChart(0, {0, 1, 0}, 4, 4, 1, 1, 1);
  scene.addSide(false, [](int, int) { return Rgb(1.f); });
  scene.addDirection(3, [](int x, int y) { return Rgb(x == 1 && y == 2 ? 85.f : 1.f); });  // mean 100/16
  scene.setAtlas(8, 8);
  const LdrScales scales = ldrScales(scene.maps(), 4);
  ASSERT_EQ(scales.scales.size(), 1u);
  EXPECT_FLOAT_EQ(scales.scales[0], 25);
  EXPECT_NEAR(scales.cutFlux, 0.6, 1e-6);
  const LightMaps after = reread(scene, {MapFormat::ldr8, ExrCompression::rle, 4});
  EXPECT_FLOAT_EQ(after.directional[2 * 4 + 1].x, 25);
  EXPECT_NEAR(after.directional[0].x, 1, 0.02);
}

TEST(MapFormats, TheCodedOnesTakeLessOfTheDisk) {
  const TempFolder folder;
  const BakedScene scene = smallBakedScene();
  const auto bytes = [&](MapFormat format) {
    scene.write(folder / "room.dlm", {format, ExrCompression::none});
    return std::filesystem::file_size(folder / "room.dlm" / "directional.exr");
  };
  const auto whole = bytes(MapFormat::float32);
  EXPECT_LT(bytes(MapFormat::half), whole);
  EXPECT_LT(bytes(MapFormat::rgb9e5), bytes(MapFormat::half));
  EXPECT_LE(bytes(MapFormat::ldr8), bytes(MapFormat::rgb9e5));
}

class HostileFormats : public ::testing::Test {
 protected:
  HostileFormats() { smallBakedScene().write(path_, {MapFormat::ldr8, ExrCompression::none}); }
  /// The manifest without its seal's word on itself, edited.
  void edit(const std::function<void(nlohmann::json&)>& change) {
    const std::vector<std::uint8_t> bytes = readFile(path_ / "manifest.json");
    nlohmann::json manifest = nlohmann::json::parse(bytes.begin(), bytes.end());
    change(manifest);
    writeFileAtomically(path_ / "manifest.json", manifest.dump());
  }
  void expectRefused(const std::string& word) {
    const std::string text = errorOf(ExitCode::badInput, [&] { readDlm(path_); });
    EXPECT_NE(text.find(word), std::string::npos) << text;
  }
  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "room.dlm";
};

TEST_F(HostileFormats, ScalesThatAreMissingTooManyOrNegativeAreRefused) {
  EXPECT_NO_THROW(readDlm(path_));
  edit([](nlohmann::json& m) { m["directional"]["map_scales"].push_back(1.0); });
  expectRefused("map_scales");
  edit([](nlohmann::json& m) { m["directional"]["map_scales"].erase(0); });
  edit([](nlohmann::json& m) { m["directional"]["map_scales"][0] = -1.0; });
  expectRefused("map_scales");
  edit([](nlohmann::json& m) { m["directional"]["map_scales"][0] = 1e300; });
  expectRefused("map_scales");
  edit([](nlohmann::json& m) { m["directional"].erase("map_scales"); });
  expectRefused("map_scales");
}

TEST_F(HostileFormats, FormatsThatAreUnknownOrNotThoseOfTheChannelsAreRefused) {
  edit([](nlohmann::json& m) { m["directional"]["format"] = "jpeg"; });
  expectRefused("format");
  edit([](nlohmann::json& m) { m["directional"]["format"] = "rgb9e5"; });
  expectRefused("RGB9E5");
  edit([](nlohmann::json& m) { m["directional"]["format"] = "half"; });
  expectRefused("channel R");
}

}  // namespace
}  // namespace lucarne::map_formats_test
