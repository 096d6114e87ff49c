// readExrRgb on files that we do not write ourselves: tiles, levels, windows that differ, luminance alone; made with
// the library.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <cstring>

#include "base/files.h"
#include "base/image_file.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::exr_picture_test {
namespace {

namespace imf = OPENEXR_IMF_NAMESPACE;
namespace imath = IMATH_NAMESPACE;
using ::testing::HasSubstr;

/// What a file stores at (x, y) of its coordinates.
Rgb valueAt(int x, int y) {
  return {1 + static_cast<float>(x), 200 + static_cast<float>(y), static_cast<float>(x * y)};
}

imath::Box2i window(int x0, int y0, int x1, int y1) { return {imath::V2i(x0, y0), imath::V2i(x1, y1)}; }

imf::Header headerOf(const imath::Box2i& display, const imath::Box2i& data, const std::string& channels,
                     imf::PixelType type = imf::FLOAT) {
  imf::Header header(display, data);
  for (const char c : channels) header.channels().insert(std::string(1, c), imf::Channel(type));
  return header;
}

/// Values for each pixel of a data window, as the channels R, G, B, and Y = R.
struct Values {
  std::vector<Rgb> pixels;
  imf::FrameBuffer frame;

  Values(const imath::Box2i& data, const std::string& channels) {
    for (int y = data.min.y; y <= data.max.y; ++y)
      for (int x = data.min.x; x <= data.max.x; ++x) pixels.push_back(valueAt(x, y));
    for (const char c : channels) {
      float* const first = &pixels.front().x + (c == 'G' ? 1 : c == 'B' ? 2 : 0);
      frame.insert(std::string(1, c), imf::Slice::Make(imf::FLOAT, first, data, sizeof(Rgb)));
    }
  }
};

void writeScanlines(const std::filesystem::path& path, const imath::Box2i& display, const imath::Box2i& data,
                    const std::string& channels = "RGB") {
  imf::OutputFile file(path.c_str(), headerOf(display, data, channels));
  const Values values(data, channels);
  file.setFrameBuffer(values.frame);
  file.writePixels(data.max.y - data.min.y + 1);
}

/// Smaller levels hold what the first level has in their corner: all but the first are wrong on purpose.
void writeTiles(const std::filesystem::path& path, const imath::Box2i& display, const imath::Box2i& data,
                imf::LevelMode mode, const std::string& channels = "RGB") {
  imf::Header header = headerOf(display, data, channels);
  header.setTileDescription(imf::TileDescription(16, 7, mode));
  imf::TiledOutputFile file(path.c_str(), header);
  const Values values(data, channels);
  file.setFrameBuffer(values.frame);
  for (int ly = 0; ly < file.numYLevels(); ++ly)
    for (int lx = 0; lx < file.numXLevels(); ++lx)
      if (file.isValidLevel(lx, ly)) file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
}

void expectPlaced(const ImageRgb& image, const imath::Box2i& display, const imath::Box2i& data) {
  ASSERT_EQ(image.width, display.max.x - display.min.x + 1);
  ASSERT_EQ(image.height, display.max.y - display.min.y + 1);
  std::size_t i = 0;
  for (int y = display.min.y; y <= display.max.y; ++y)
    for (int x = display.min.x; x <= display.max.x; ++x)
      ASSERT_EQ(image.pixels[i++], data.intersects(imath::V2i(x, y)) ? valueAt(x, y) : Rgb(0)) << x << ", " << y;
}

class ExrTiled : public ::testing::TestWithParam<imf::LevelMode> {};

TEST_P(ExrTiled, GivesTheLargestLevel) {
  const TempFolder folder;
  const imath::Box2i whole = window(0, 0, 52, 32);
  writeTiles(folder / "a.exr", whole, whole, GetParam());
  expectPlaced(readExrRgb(folder / "a.exr"), whole, whole);
}

TEST_P(ExrTiled, IsPlacedInItsDisplayWindow) {
  const TempFolder folder;
  const imath::Box2i display = window(-3, 5, 60, 40), data = window(-20, 11, 30, 50);
  writeTiles(folder / "a.exr", display, data, GetParam());
  expectPlaced(readExrRgb(folder / "a.exr"), display, data);
}

INSTANTIATE_TEST_SUITE_P(Levels, ExrTiled, ::testing::Values(imf::ONE_LEVEL, imf::MIPMAP_LEVELS, imf::RIPMAP_LEVELS));

TEST(ExrPicture, CroppedOverscannedAndDisjointWindowsArePlaced) {
  const TempFolder folder;
  const imath::Box2i display = window(2, -4, 21, 9);
  for (const imath::Box2i& data : {window(5, 0, 7, 1), window(-10, -20, 40, 30), window(2, -4, 2, -4),
                                   window(21, 9, 30, 30), window(100, 0, 120, 3), window(3, 40, 9, 41)}) {
    writeScanlines(folder / "a.exr", display, data);
    expectPlaced(readExrRgb(folder / "a.exr"), display, data);
  }
}

TEST(ExrPicture, LuminanceAloneIsGreyInScanlinesAndTiles) {
  const TempFolder folder;
  const imath::Box2i whole = window(0, 0, 30, 20);
  writeScanlines(folder / "a.exr", whole, whole, "Y");
  writeTiles(folder / "b.exr", whole, whole, imf::ONE_LEVEL, "AY");
  for (const char* name : {"a.exr", "b.exr"}) {
    const ImageRgb image = readExrRgb(folder / name);
    ASSERT_EQ(image.pixels.size(), 31u * 21u);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_EQ(image.pixels[i], Rgb(valueAt(static_cast<int>(i % 31), 0).x));
  }
}

TEST(ExrPicture, MissingColoursAreAnInputError) {
  const TempFolder folder;
  const imath::Box2i whole = window(0, 0, 3, 3);
  for (const char* channels : {"RG", "A", "B"}) {
    writeScanlines(folder / "a.exr", whole, whole, channels);
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExrRgb(folder / "a.exr"); }), HasSubstr("a.exr")) << channels;
  }
}

TEST(ExrPicture, TiledLayersAreStillNoLayers) {
  const TempFolder folder;
  writeTiles(folder / "a.exr", window(0, 0, 3, 3), window(0, 0, 3, 3), imf::ONE_LEVEL);
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExr(folder / "a.exr"); }), HasSubstr("tiled"));
}

class ExrForged : public ::testing::Test {
 protected:
  /// The bytes of a tiled file, with `numbers` written over the value of an attribute, `skip` bytes into it.
  void forge(const std::string& key, const std::string& type, std::size_t skip, std::vector<std::int32_t> numbers) {
    writeTiles(folder_ / "a.exr", window(0, 0, 20, 20), window(0, 0, 20, 20), imf::MIPMAP_LEVELS);
    std::vector<std::uint8_t> bytes = readFile(folder_ / "a.exr");
    const std::string mark = key + '\0' + type + '\0';
    const auto at = std::search(bytes.begin(), bytes.end(), mark.begin(), mark.end());
    ASSERT_NE(at, bytes.end());
    std::memcpy(&*at + mark.size() + 4 + skip, numbers.data(), 4 * numbers.size());
    writeFileAtomically(folder_ / "b.exr", bytes);
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExrRgb(folder_ / "b.exr"); }), HasSubstr("b.exr"));
  }

  TempFolder folder_;
};

TEST_F(ExrForged, TileSizesBeyondReasonAreRefused) {
  for (const std::int32_t side : {0, -1, 0x7fffffff, 30000}) forge("tiles", "tiledesc", 0, {side, side});
  forge("tiles", "tiledesc", 0, {1 << 30, 1});
  forge("tiles", "tiledesc", 0, {1, 1 << 30});
}

TEST_F(ExrForged, WindowsBeyondReasonAreRefused) {
  for (const char* key : {"dataWindow", "displayWindow"}) {
    forge(key, "box2i", 0, {0, 0, 30000, 30000});
    forge(key, "box2i", 0, {-0x7fffffff, -0x7fffffff, 0x7fffffff, 0x7fffffff});
    forge(key, "box2i", 0, {5, 5, 0, 0});
  }
}

TEST_F(ExrForged, EveryTruncationIsAnInputError) {
  writeTiles(folder_ / "a.exr", window(0, 0, 20, 20), window(0, 0, 20, 20), imf::ONE_LEVEL);
  const std::vector<std::uint8_t> bytes = readFile(folder_ / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 50) {
    writeFileAtomically(folder_ / "b.exr", std::span(bytes).first(length));
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExrRgb(folder_ / "b.exr"); }), HasSubstr("b.exr")) << length;
  }
}

}  // namespace
}  // namespace lucarne::exr_picture_test
