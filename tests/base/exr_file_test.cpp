#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/files.h"
#include "base/image_file.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::exr_file_test {
namespace {

using ::testing::HasSubstr;

ExrChannel floatChannel(const std::string& name, ChannelType type, std::vector<float> values) {
  return {name, type, std::move(values), {}};
}

/// All three types of channel; values that a narrower type would change.
ExrLayer sampleLayer(const std::string& name, int width, int height) {
  ExrLayer layer{name, width, height, {}, {{"note", "of " + name}}};
  std::vector<float> floats, halves;
  std::vector<std::uint32_t> uints;
  for (int i = 0; i < width * height; ++i) {
    floats.push_back(1.0f / static_cast<float>(i + 1) - 0.1f);
    halves.push_back(static_cast<float>(i % 2048) * 0.25f);
    uints.push_back(0xffffffffu - static_cast<std::uint32_t>(i) * 2654435761u);
  }
  layer.channels = {{"r.hi", ChannelType::uint32, {}, uints},
                    floatChannel("B", ChannelType::float32, floats),
                    floatChannel("A", ChannelType::half, halves)};
  return layer;
}

void expectSame(const ExrLayer& a, const ExrLayer& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.attributes, b.attributes);
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (const ExrChannel& channel : a.channels) {
    const ExrChannel* other = b.find(channel.name);
    ASSERT_NE(other, nullptr) << channel.name;
    EXPECT_EQ(channel.type, other->type);
    EXPECT_EQ(channel.floats, other->floats);
    EXPECT_EQ(channel.uints, other->uints);
  }
}

class ExrRoundTrip : public ::testing::TestWithParam<ExrCompression> {};

TEST_P(ExrRoundTrip, KeepsEveryBitOfManyLayers) {
  const TempFolder folder;
  const std::vector<ExrLayer> layers = {sampleLayer("zeta", 37, 11), sampleLayer("alpha", 37, 11),
                                        sampleLayer("page 3", 37, 11)};
  writeExr(folder / "a.exr", layers, GetParam());
  const std::vector<ExrLayer> read = readExr(folder / "a.exr");
  ASSERT_EQ(read.size(), layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) expectSame(layers[i], read[i]);
}

TEST_P(ExrRoundTrip, KeepsEveryBitOfOneLayerWithAndWithoutName) {
  const TempFolder folder;
  for (const std::string name : {"", "only"}) {
    const ExrLayer layer = sampleLayer(name, 5, 300);
    writeExr(folder / "a.exr", {layer}, GetParam());
    const std::vector<ExrLayer> read = readExr(folder / "a.exr");
    ASSERT_EQ(read.size(), 1u);
    expectSame(layer, read[0]);
  }
}

TEST_P(ExrRoundTrip, WritesTheSameBytesAgain) {
  const TempFolder folder;
  for (const char* name : {"a.exr", "b.exr"}) {
    writeExr(folder / name, {sampleLayer("x", 64, 64), sampleLayer("y", 64, 64)}, GetParam());
  }
  EXPECT_EQ(readFile(folder / "a.exr"), readFile(folder / "b.exr"));
}

TEST_P(ExrRoundTrip, HoldsOnePixel) {
  const TempFolder folder;
  writeExr(folder / "a.exr", {sampleLayer("", 1, 1)}, GetParam());
  expectSame(sampleLayer("", 1, 1), readExr(folder / "a.exr").at(0));
}

INSTANTIATE_TEST_SUITE_P(Compressions, ExrRoundTrip,
                         ::testing::Values(ExrCompression::none, ExrCompression::rle, ExrCompression::zips));

TEST(ExrFile, UnnamedLayerIsAPlainSinglePartFile) {
  const TempFolder folder;
  writeExrRgb(folder / "a.exr", {2, 1, {Rgb(1, 2, 3), Rgb(4, 5, 6)}});
  const std::vector<std::uint8_t> bytes = readFile(folder / "a.exr");
  std::uint32_t version = 0;
  std::memcpy(&version, bytes.data() + 4, 4);
  EXPECT_EQ(version, 2u);  // no flag set: neither tiled, deep nor multi-part
}

TEST(ExrFile, LayersOfDifferentSizeComeBackWithTheirOwn) {
  const TempFolder folder;
  const std::vector<ExrLayer> layers = {sampleLayer("a", 8, 3), sampleLayer("b", 2, 9)};
  writeExr(folder / "a.exr", layers, ExrCompression::rle);
  const std::vector<ExrLayer> read = readExr(folder / "a.exr");
  ASSERT_EQ(read.size(), 2u);
  expectSame(layers[0], read[0]);
  expectSame(layers[1], read[1]);
}

TEST(ExrFile, HalfKeepsFiniteValuesFiniteAndPassesNanAndInfinityOn) {
  const TempFolder folder;
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  ExrLayer layer{"", 5, 1, {floatChannel("R", ChannelType::half, {1e9f, -1e9f, infinity, -infinity, nan})}, {}};
  writeExr(folder / "a.exr", {layer}, ExrCompression::none);
  const std::vector<float> read = readExr(folder / "a.exr").at(0).channels.at(0).floats;
  EXPECT_EQ(read[0], 65504.0f);
  EXPECT_EQ(read[1], -65504.0f);
  EXPECT_EQ(read[2], infinity);
  EXPECT_EQ(read[3], -infinity);
  EXPECT_TRUE(std::isnan(read[4]));
}

TEST(ExrFile, RgbImageComesBackAndGreyIsWidened) {
  const TempFolder folder;
  const ImageRgb image{2, 2, {Rgb(1, 2, 3), Rgb(4, 5, 6), Rgb(-7, 8e-20f, 9e30f), Rgb(0)}};
  writeExrRgb(folder / "a.exr", image);
  EXPECT_EQ(readExrRgb(folder / "a.exr").pixels, image.pixels);
  writeExr(folder / "y.exr", {{"", 2, 1, {floatChannel("Y", ChannelType::float32, {3, 4})}, {}}}, ExrCompression::zips);
  EXPECT_EQ(readExrRgb(folder / "y.exr").pixels, (std::vector<Rgb>{Rgb(3), Rgb(4)}));
  writeExr(folder / "u.exr", {{"", 1, 1, {{"R", ChannelType::uint32, {}, {1}}}, {}}}, ExrCompression::zips);
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExrRgb(folder / "u.exr"); }), HasSubstr("u.exr"));
}

TEST(ExrFile, FullDiskAndBadFoldersAreErrorsAndLeaveNothing) {
  const TempFolder folder;
  const std::vector<ExrLayer> layers = {sampleLayer("a", 8, 3)};
  errorOf(ExitCode::outOfResource, [&] { writeExr("/dev/full", layers, ExrCompression::none); });
  errorOf(ExitCode::failed, [&] { writeExr(folder / "missing/a.exr", layers, ExrCompression::none); });
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(ExrFile, ContentsThatDoNotMatchTheSizeAreABrokenContract) {
  const TempFolder folder;
  ExrLayer layer = sampleLayer("a", 8, 3);
  layer.height = 4;
  EXPECT_THROW(writeExr(folder / "a.exr", {layer}, ExrCompression::none), std::logic_error);
}

TEST(ExrFile, EveryTruncationIsAnInputErrorThatNamesTheFile) {
  const TempFolder folder;
  writeExr(folder / "a.exr", {sampleLayer("a", 8, 3), sampleLayer("b", 8, 3)}, ExrCompression::rle);
  const std::vector<std::uint8_t> bytes = readFile(folder / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 50) {
    writeFileAtomically(folder / "cut.exr", std::span(bytes).first(length));
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExr(folder / "cut.exr"); }), HasSubstr("cut.exr")) << length;
  }
}

TEST(ExrFile, ASizeThatTheFileCannotHoldIsRefusedBeforeItIsAllocated) {
  const TempFolder folder;
  writeExr(folder / "a.exr", {sampleLayer("", 8, 3)}, ExrCompression::none);
  std::vector<std::uint8_t> bytes = readFile(folder / "a.exr");
  const std::string key = "dataWindow";
  const auto at = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
  ASSERT_NE(at, bytes.end());
  const auto maxCorner = at + 11 + 6 + 4 + 8;  // after the name, "box2i", the length and the low corner
  for (const std::int32_t side : {30000, 0x7ffffffe, -5}) {
    std::memcpy(&*maxCorner, &side, 4);
    std::memcpy(&*maxCorner + 4, &side, 4);
    writeFileAtomically(folder / "b.exr", bytes);
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExr(folder / "b.exr"); }), HasSubstr("b.exr")) << side;
  }
}

}  // namespace
}  // namespace lucarne::exr_file_test
