#include <gmock/gmock.h>

#include "base/files.h"
#include "base/image_file.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::picture_file_test {
namespace {

using ::testing::HasSubstr;

ImageRgb readHdrText(const TempFolder& folder, const std::string& text) {
  writeFileAtomically(folder / "a.hdr", text);
  return readHdr(folder / "a.hdr");
}

std::string hdrHeader(int width, int height) {
  return "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n";
}

TEST(HdrFile, FlatPixelsDecodeToMantissaTimesPowerOfTwo) {
  const TempFolder folder;
  const std::string pixels("\x80\x40\x20\x81\xff\x01\x00\x88\x10\x20\x30\x00", 12);
  const ImageRgb image = readHdrText(folder, hdrHeader(3, 1) + pixels);
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 1);
  EXPECT_EQ(image.pixels[0], Rgb(1, 0.5f, 0.25f));
  EXPECT_EQ(image.pixels[1], Rgb(255, 1, 0));
  EXPECT_EQ(image.pixels[2], Rgb(0));
}

TEST(HdrFile, BothRunLengthCodesGiveTheSamePixels) {
  const TempFolder folder;
  std::string flat, old, planes;
  for (int i = 0; i < 10; ++i) flat += "\x80\x40\x20\x81";
  old = std::string("\x80\x40\x20\x81") + "\x01\x01\x01\x09";
  planes = std::string("\x02\x02\x00\x0a", 4) + "\x8a\x80" + "\x85\x40\x85\x40" + "\x02\x20\x20\x88\x20" + "\x8a\x81";
  const std::vector<Rgb> expected(10, Rgb(1, 0.5f, 0.25f));
  EXPECT_EQ(readHdrText(folder, hdrHeader(10, 1) + flat).pixels, expected);
  EXPECT_EQ(readHdrText(folder, hdrHeader(10, 1) + old).pixels, expected);
  EXPECT_EQ(readHdrText(folder, hdrHeader(10, 1) + planes).pixels, expected);
}

TEST(HdrFile, NarrowPicturesAreNeverRunLengthCodedPlanes) {
  const TempFolder folder;
  const std::string pixel("\x02\x02\x00\x81", 4);  // would start a line of planes in a wider picture
  EXPECT_EQ(readHdrText(folder, hdrHeader(1, 1) + pixel).pixels[0], Rgb(0.015625f, 0.015625f, 0));
}

TEST(HdrFile, ExposuresAreDividedOut) {
  const TempFolder folder;
  const std::string text = "#?RGBE\nEXPOSURE=2\nEXPOSURE= 4.0\n\n-Y 1 +X 1\n";
  EXPECT_EQ(readHdrText(folder, text + "\x80\x40\x20\x81").pixels[0], Rgb(0.125f, 0.0625f, 0.03125f));
}

TEST(HdrFile, EveryTruncationAndBadHeaderIsAnInputError) {
  const TempFolder folder;
  const std::string whole = hdrHeader(10, 1) + std::string("\x02\x02\x00\x0a", 4) + "\x8a\x80\x8a\x40\x8a\x20\x8a\x81";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readHdrText(folder, whole.substr(0, length)); }), HasSubstr("a.hdr"));
  }
  const std::string pixel = "\x80\x40\x20\x81";
  for (const char* bad :
       {"#?RGBE\n\n+Y 1 +X 1\n", "#?RGBE\n\n-Y 1 +X 1 \n", "#?RGBE\n\n-Y 99999999999 +X 1\n", "#?RGBE\n\n-Y 0 +X 1\n",
        "#?RGBE\n\n-Y -1 +X 1\n", "#?RGBE\nEXPOSURE=0\n\n-Y 1 +X 1\n", "#?RGBE\nEXPOSURE=nan\n\n-Y 1 +X 1\n",
        "#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "#?RGBE\n\n-Y 30000 +X 30000\n"}) {
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readHdrText(folder, bad + pixel); }), HasSubstr("a.hdr")) << bad;
  }
}

TEST(PngFile, WrittenPixelsDecodeToThemselvesAndTheBytesRepeat) {
  const TempFolder folder;
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < 31 * 17 * 3; ++i) rgb.push_back(static_cast<std::uint8_t>(i * 37));
  writePng(folder / "a.png", 31, 17, rgb);
  writePng(folder / "b.png", 31, 17, rgb);
  EXPECT_EQ(readFile(folder / "a.png"), readFile(folder / "b.png"));
  const DecodedImage image = decodeImage(readFile(folder / "a.png"), "a.png");
  ASSERT_EQ(image.width, 31);
  ASSERT_EQ(image.height, 17);
  ASSERT_EQ(image.rgba.size(), 31u * 17u * 4u);
  for (std::size_t i = 0; i < 31 * 17; ++i) {
    for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(image.rgba[4 * i + c], rgb[3 * i + c]);
    ASSERT_EQ(image.rgba[4 * i + 3], 255);
  }
}

TEST(PngFile, FullDiskIsOutOfResource) {
  const std::vector<std::uint8_t> rgb(3, 0);
  errorOf(ExitCode::outOfResource, [&] { writePng("/dev/full", 1, 1, rgb); });
  EXPECT_THROW(writePng("/dev/null", 2, 1, rgb), std::logic_error);
}

TEST(DecodeImage, OtherKindsAndDamageAreInputErrorsWithTheGivenName) {
  const TempFolder folder;
  const std::vector<std::uint8_t> rgb(300 * 3, 90);
  writePng(folder / "a.png", 300, 1, rgb);
  std::vector<std::uint8_t> bytes = readFile(folder / "a.png");
  const auto decode = [&] { decodeImage(bytes, "texture 7"); };
  for (std::size_t length : {0u, 7u, 8u, 20u, 33u, 50u}) {
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { decodeImage(std::span(bytes).first(length), "texture 7"); }),
                HasSubstr("texture 7"));
  }
  bytes[16] = 0x00, bytes[17] = 0xff;  // the width: 16.7 million
  EXPECT_THAT(errorOf(ExitCode::badInput, decode), HasSubstr("texture 7"));
  bytes = {'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_THAT(errorOf(ExitCode::badInput, decode), HasSubstr("neither PNG nor JPEG"));
}

}  // namespace
}  // namespace lucarne::picture_file_test
