#include "base/exr_layers.h"

#include <gmock/gmock.h>

#include <mutex>
#include <set>

#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::exr_layers_test {
namespace {

/// Layers of different sizes and channels, so that memory that serves again is seen to.
std::vector<ExrLayer> sampleLayers(int count) {
  std::vector<ExrLayer> layers;
  for (int i = 0; i < count; ++i) {
    ExrLayer layer{"layer " + std::to_string(i), 3 + i % 5, 2 + i % 7, {}, {{"note", std::to_string(i)}}};
    const auto pixels = static_cast<std::size_t>(layer.width * layer.height);
    if (i % 3 == 0) layer.channels.push_back({"CODE", ChannelType::uint32, {}, std::vector<std::uint32_t>(pixels, 7u + static_cast<unsigned>(i))});
    if (i % 3 != 0 || i % 2 == 0) layer.channels.push_back({"Y", ChannelType::float32, std::vector<float>(pixels, static_cast<float>(i)), {}});
    layers.push_back(layer);
  }
  return layers;
}

TEST(ExrLayers, AreThoseOfTheWholeFileWhicheverThreadReadsThem) {
  const TempFolder folder;
  writeExr(folder / "a.exr", sampleLayers(60), ExrCompression::rle);
  const std::vector<ExrLayer> whole = readExr(folder / "a.exr");
  std::mutex mutex;
  std::set<std::size_t> seen;
  ExrLayerUse use;
  use.choose = [&](const std::vector<ExrLayer>& heads) {
    EXPECT_EQ(heads.size(), whole.size());
    EXPECT_EQ(heads[7].name, whole[7].name);
    EXPECT_EQ(heads[7].attributes, whole[7].attributes);
    EXPECT_TRUE(heads[7].channels.at(0).floats.empty());
    std::vector<bool> wanted(heads.size(), true);
    wanted[5] = false;
    return wanted;
  };
  use.take = [&](std::size_t i, const ExrLayer& layer) {
    const std::lock_guard lock(mutex);
    seen.insert(i);
    EXPECT_EQ(layer.name, whole[i].name);
    ASSERT_EQ(layer.channels.size(), whole[i].channels.size());
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
      EXPECT_EQ(layer.channels[c].floats, whole[i].channels[c].floats);
      EXPECT_EQ(layer.channels[c].uints, whole[i].channels[c].uints);
    }
  };
  readExrLayers(folder / "a.exr", use);
  EXPECT_EQ(seen.size(), whole.size() - 1);
  EXPECT_EQ(seen.count(5), 0u);
}

TEST(ExrLayers, WhatTheUserThrowsIsThrownOn) {
  const TempFolder folder;
  writeExr(folder / "a.exr", sampleLayers(20), ExrCompression::none);
  ExrLayerUse use;
  use.choose = [](const std::vector<ExrLayer>& heads) { return std::vector<bool>(heads.size(), true); };
  use.take = [](std::size_t i, const ExrLayer&) {
    if (i == 11) throw InputError("the eleventh");
  };
  EXPECT_EQ(errorOf(ExitCode::badInput, [&] { readExrLayers(folder / "a.exr", use); }), "the eleventh");
}

TEST(ExrLayers, ACutFileIsAnErrorThatNamesIt) {
  const TempFolder folder;
  writeExr(folder / "a.exr", sampleLayers(20), ExrCompression::none);
  std::filesystem::resize_file(folder / "a.exr", std::filesystem::file_size(folder / "a.exr") - 20);
  ExrLayerUse use;
  use.choose = [](const std::vector<ExrLayer>& heads) { return std::vector<bool>(heads.size(), true); };
  use.take = [](std::size_t, const ExrLayer&) {};
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { readExrLayers(folder / "a.exr", use); }), ::testing::HasSubstr("a.exr"));
}

}  // namespace
}  // namespace lucarne::exr_layers_test
