#include "base/exr_pixels.h"

#include <gmock/gmock.h>

#include <cstring>
#include <mutex>
#include <set>

#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::exr_pixels_test {
namespace {

/// Layers of different sizes and channels, so that memory that serves again is seen to.
std::vector<ExrLayer> sampleLayers(int count) {
  std::vector<ExrLayer> layers;
  for (int i = 0; i < count; ++i) {
    ExrLayer layer{"layer " + std::to_string(i), 3 + i % 5, 2 + i % 7, {}, {{"note", std::to_string(i)}}};
    const auto pixels = static_cast<std::size_t>(layer.width * layer.height);
    if (i % 3 == 0) {
      std::vector<std::uint32_t> codes(pixels);
      for (std::size_t p = 0; p < pixels; ++p) codes[p] = static_cast<std::uint32_t>(i) << 16 | static_cast<std::uint32_t>(p);
      layer.channels.push_back({"CODE", ChannelType::uint32, {}, codes});
    } else {
      std::vector<float> red(pixels), green(pixels);
      for (std::size_t p = 0; p < pixels; ++p) {
        red[p] = static_cast<float>(i) + static_cast<float>(p) / 64;
        green[p] = -red[p];
      }
      const ChannelType type = i % 2 == 0 ? ChannelType::half : ChannelType::float32;
      layer.channels = {{"G", type, green, {}}, {"R", type, red, {}}};
    }
    layers.push_back(layer);
  }
  return layers;
}

template <class T>
T valueAt(std::span<const std::byte> bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, &bytes[offset], sizeof value);
  return value;
}

/// Rows 1 to the last but one, red before green and a channel that is not there between them.
ExrWish wishFor(const ExrLayer& head) {
  ExrWish wish;
  if (head.channels[0].type == ChannelType::uint32) {
    wish.slots = {{"CODE", ChannelType::uint32}};
  } else {
    wish.slots = {{"R", ChannelType::float32}, {"B", ChannelType::half}, {"G", ChannelType::float32}};
  }
  wish.firstRow = 1;
  wish.endRow = head.height - 1;
  return wish;
}

void expectPixels(const ExrLayer& layer, std::span<const std::byte> pixels) {
  const ExrWish wish = wishFor(layer);
  const auto width = static_cast<std::size_t>(layer.width);
  ASSERT_EQ(pixels.size(), wish.pixelBytes() * width * static_cast<std::size_t>(wish.endRow - wish.firstRow));
  for (std::size_t p = 0; p < pixels.size() / wish.pixelBytes(); ++p) {
    const std::size_t at = p * wish.pixelBytes(), source = p + width;
    if (wish.slots.size() == 1) {
      EXPECT_EQ(valueAt<std::uint32_t>(pixels, at), layer.channels[0].uints[source]);
    } else {
      EXPECT_EQ(valueAt<float>(pixels, at), layer.find("R")->floats[source]);
      EXPECT_EQ(valueAt<std::uint16_t>(pixels, at + 4), 0);
      EXPECT_EQ(valueAt<float>(pixels, at + 6), layer.find("G")->floats[source]);
    }
  }
}

TEST(ExrPixels, AreThoseOfTheWholeFileWhicheverThreadReadsThem) {
  const TempFolder folder;
  for (const ExrCompression compression : {ExrCompression::none, ExrCompression::rle, ExrCompression::zips}) {
    writeExr(folder / "a.exr", sampleLayers(60), compression);
    const std::vector<ExrLayer> whole = readExr(folder / "a.exr");
    std::mutex mutex;
    std::set<std::size_t> seen, wanted;
    ExrPixelUse use;
    use.choose = [&](const std::vector<ExrLayer>& heads) {
      EXPECT_EQ(heads.size(), whole.size());
      EXPECT_EQ(heads[7].name, whole[7].name);
      EXPECT_EQ(heads[7].attributes, whole[7].attributes);
      EXPECT_TRUE(heads[7].channels.at(0).floats.empty());
      std::vector<ExrWish> wishes;
      for (std::size_t i = 0; i < heads.size(); ++i) {
        wishes.push_back(i == 5 ? ExrWish{} : wishFor(heads[i]));
        if (wishes.back().any()) wanted.insert(i);
      }
      return wishes;
    };
    use.take = [&](std::size_t i, std::span<const std::byte> pixels) {
      const std::lock_guard lock(mutex);
      seen.insert(i);
      expectPixels(whole[i], pixels);
    };
    readExrPixels(folder / "a.exr", use);
    EXPECT_EQ(seen, wanted);
    EXPECT_LT(seen.size(), whole.size());
  }
}

ExrPixelUse useOfAll(const std::function<void(std::size_t)>& take) {
  ExrPixelUse use;
  use.choose = [](const std::vector<ExrLayer>& heads) {
    std::vector<ExrWish> wishes;
    for (const ExrLayer& head : heads) {
      ExrWish wish;
      for (const ExrChannel& c : head.channels) wish.slots.push_back({c.name, c.type});
      wish.endRow = head.height;
      wishes.push_back(wish);
    }
    return wishes;
  };
  use.take = [take](std::size_t i, std::span<const std::byte>) { take(i); };
  return use;
}

TEST(ExrPixels, WhatTheUserThrowsIsThrownOn) {
  const TempFolder folder;
  writeExr(folder / "a.exr", sampleLayers(20), ExrCompression::none);
  const ExrPixelUse use = useOfAll([](std::size_t i) {
    if (i == 11) throw InputError("the eleventh");
  });
  EXPECT_EQ(errorOf(ExitCode::badInput, [&] { readExrPixels(folder / "a.exr", use); }), "the eleventh");
}

TEST(ExrPixels, ACutFileIsAnErrorThatNamesIt) {
  const TempFolder folder;
  writeExr(folder / "a.exr", sampleLayers(20), ExrCompression::none);
  std::filesystem::resize_file(folder / "a.exr", std::filesystem::file_size(folder / "a.exr") - 20);
  const ExrPixelUse use = useOfAll([](std::size_t) {});
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExrPixels(folder / "a.exr", use); }), ::testing::HasSubstr("a.exr"));
}

}  // namespace
}  // namespace lucarne::exr_pixels_test
