// A part is an OpenEXR file: read by the library itself, which knows nothing of parts.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"

namespace lucarne::exr_rows_test {
namespace {

using Channels = std::map<std::string, std::vector<std::uint32_t>>;

constexpr std::uint64_t kLightEntries = 5000, kTexels = 2049;
constexpr std::size_t kSceneBytes = 3 * 4 * kPartWidth + 5;

/// All pixels of a layer as the library reads them, by channel.
Channels readLayer(Imf::MultiPartInputFile& file, int layer) {
  Imf::InputPart part(file, layer);
  const Imath::Box2i window = part.header().dataWindow();
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1),
             height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
  Channels channels;
  Imf::FrameBuffer buffer;
  for (auto c = part.header().channels().begin(); c != part.header().channels().end(); ++c) {
    EXPECT_EQ(c.channel().type, Imf::UINT) << c.name();
    std::vector<std::uint32_t>& pixels = channels[c.name()];
    pixels.resize(width * height);
    buffer.insert(c.name(), Imf::Slice(Imf::UINT, reinterpret_cast<char*>(pixels.data()), sizeof(std::uint32_t),
                                       width * sizeof(std::uint32_t)));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
  return channels;
}

std::vector<std::string> namesOf(const Channels& channels) {
  std::vector<std::string> names;
  for (const auto& [name, pixels] : channels) names.push_back(name);
  return names;
}

class ExrRowsFile : public ::testing::Test {
 protected:
  ExrRowsFile() : part_(madeUpPartOf()), path_((folder_ / "x.part").string()) {
    part_.write(path_);
    file_.emplace(path_.c_str());
  }

  /// Channel `name` of the layer holds these values, and zeros behind them.
  static void expectValues(const Channels& channels, const std::string& name, std::span<const std::int64_t> tallies,
                           std::size_t stride, std::size_t offset) {
    const auto &high = channels.at(name + ".hi"), &low = channels.at(name + ".lo");
    std::size_t different = 0;
    for (std::size_t i = 0; i < high.size(); ++i) {
      const std::uint64_t value = std::uint64_t{high[i]} << 32 | low[i];
      const std::size_t at = i * stride + offset;
      different += value != (at < tallies.size() ? static_cast<std::uint64_t>(tallies[at]) : 0);
    }
    EXPECT_EQ(different, 0u) << name;
  }

  test::MadeUpPart part_;
  TempFolder folder_;
  std::string path_;
  std::optional<Imf::MultiPartInputFile> file_;

 private:
  static test::MadeUpPart madeUpPartOf() {
    test::MadeUpPart part = test::madeUpPart({0, 250}, 1, 1, kSceneBytes);
    part.tallies = test::madeUpTallies(kLightEntries, kTexels, 5, test::kMostTally);
    return part;
  }
};

TEST_F(ExrRowsFile, HasTheLayersThatItPromises) {
  ASSERT_EQ(file_->parts(), 3);
  EXPECT_EQ(file_->header(0).name(), "scene");
  EXPECT_EQ(file_->header(1).name(), "photons.light");
  EXPECT_EQ(file_->header(2).name(), "photons.statistics");
  for (int layer = 0; layer < 3; ++layer) {
    EXPECT_TRUE(file_->partComplete(layer)) << layer;
    EXPECT_EQ(file_->header(layer).compression(), Imf::NO_COMPRESSION) << layer;
    EXPECT_EQ(file_->header(layer).dataWindow().max.x, kPartWidth - 1) << layer;
    EXPECT_NO_THROW(file_->header(layer).sanityCheck(false, true)) << layer;
  }
  EXPECT_EQ(file_->header(0).dataWindow().max.y, 3);
  EXPECT_EQ(file_->header(1).dataWindow().max.y, 2);
  EXPECT_EQ(file_->header(2).dataWindow().max.y, 1);
}

TEST_F(ExrRowsFile, TellsOfItselfInAnAttribute) {
  const auto* attribute = file_->header(0).findTypedAttribute<Imf::StringAttribute>("lucarne");
  ASSERT_NE(attribute, nullptr);
  const nlohmann::json json = nlohmann::json::parse(attribute->value());
  EXPECT_EQ(json["format"], "lucarne-part");
  EXPECT_EQ(json["content_hash"], part_.tallies.contentHash().hex());
  EXPECT_EQ(json["scene_bytes"], kSceneBytes);
  EXPECT_EQ(json["tally_sets"][0]["ranges"], nlohmann::json::parse("[[0, 250]]"));
  EXPECT_EQ(file_->header(1).findTypedAttribute<Imf::StringAttribute>("lucarne"), nullptr);
}

TEST_F(ExrRowsFile, KeepsTheBytesOfTheScene) {
  const Channels channels = readLayer(*file_, 0);
  ASSERT_EQ(namesOf(channels), (std::vector<std::string>{"bytes"}));
  const std::vector<std::uint32_t>& words = channels.at("bytes");
  std::vector<std::uint8_t> bytes(words.size() * 4);
  std::memcpy(bytes.data(), words.data(), bytes.size());
  ASSERT_GE(bytes.size(), kSceneBytes);
  EXPECT_TRUE(std::equal(part_.scene.begin(), part_.scene.end(), bytes.begin()));
  EXPECT_TRUE(std::all_of(bytes.begin() + kSceneBytes, bytes.end(), [](std::uint8_t b) { return b == 0; }));
}

TEST_F(ExrRowsFile, KeepsEveryTallyToTheLastBit) {
  const Channels light = readLayer(*file_, 1), statistics = readLayer(*file_, 2);
  EXPECT_EQ(namesOf(light), (std::vector<std::string>{"b.hi", "b.lo", "g.hi", "g.lo", "r.hi", "r.lo"}));
  EXPECT_EQ(namesOf(statistics), (std::vector<std::string>{"count.hi", "count.lo", "m2.hi", "m2.lo", "odd.hi", "odd.lo"}));
  expectValues(light, "r", part_.tallies.light(), 3, 0);
  expectValues(light, "g", part_.tallies.light(), 3, 1);
  expectValues(light, "b", part_.tallies.light(), 3, 2);
  expectValues(statistics, "count", part_.tallies.statistics(), 3, 0);
  expectValues(statistics, "m2", part_.tallies.statistics(), 3, 1);
  expectValues(statistics, "odd", part_.tallies.statistics(), 3, 2);
}

TEST(ExrRows, TextAttributesAreFoundOnlyWhenWhole) {
  const ExrRows rows(4, {{"a", {"x", "y"}, 3}, {"b", {"z"}, 1}}, "note", "twelve bytes");
  const std::string& head = rows.head();
  std::uint64_t needed = 0;
  EXPECT_EQ(exrTextAttribute(head, "note", needed), "twelve bytes");
  EXPECT_EQ(needed, 0u);
  EXPECT_EQ(exrTextAttribute(head, "nota", needed), "");
  EXPECT_EQ(needed, 0u);
  const std::size_t end = head.find("twelve bytes") + 12;
  for (std::size_t size = 0; size < end; ++size) {
    EXPECT_EQ(exrTextAttribute(head.substr(0, size), "note", needed), "");
    EXPECT_GT(needed, size);
    EXPECT_LE(needed, end);
  }
  EXPECT_EQ(exrTextAttribute(head.substr(0, end), "note", needed), "twelve bytes");
}

TEST(ExrRows, SizesAreKnownBeforehand) {
  const ExrRows rows(4, {{"a", {"x", "y"}, 3}, {"b", {"z"}, 1}}, "note", "");
  EXPECT_EQ(rows.rowBytes(0), 32u);
  EXPECT_EQ(rows.rowBytes(1), 16u);
  EXPECT_EQ(rows.fileBytes(), rows.head().size() + 3 * (12 + 32) + 12 + 16);
  EXPECT_EQ(rows.rowHead(1, 0).size(), ExrRows::kRowHeadBytes);
}

}  // namespace
}  // namespace lucarne::exr_rows_test
