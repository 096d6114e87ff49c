// Parts that are cut short, altered or made up: each is refused by an error that names it, before anything large is
// made.
#include <gmock/gmock.h>

#include <functional>

#include "base/memory.h"
#include "distributed/part_file.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"

namespace lucarne::part_file_hostile_test {
namespace {

using nlohmann::json;
using test::refusalOf;
using test::setBytes;
using ::testing::HasSubstr;

/// A small part, and its bytes to spoil.
class HostilePart : public ::testing::Test {
 protected:
  HostilePart() : part_(test::madeUpPart({0, 250})), path_(folder_ / "x.part") {
    part_.write(path_);
    bytes_ = test::bytesOf(path_);
    json_ = json::parse(headerText());
    rows_.emplace(partRows(PartReader(path_).header(), ""));
  }

  std::string headerText() const {
    std::uint64_t needed = 0;
    return exrTextAttribute(bytes_, "lucarne", needed);
  }
  /// Where the row begins, its head included.
  std::size_t rowAt(PartLayer layer) const {
    std::size_t at = rows_->head().size();
    for (std::size_t i = 0; i < static_cast<std::size_t>(layer); ++i) at += ExrRows::kRowHeadBytes + rows_->rowBytes(i);
    return at;
  }
  /// The file with this header is refused with these words.
  void expectHeaderRefused(const std::string& text, const std::string& words) {
    setBytes(path_, test::forgedPart(text, bytes_.substr(rowAt(PartLayer::scene))));
    EXPECT_THAT(refusalOf(path_), HasSubstr(words)) << text.substr(0, 200);
  }
  /// The header without its settings_hash's help: only members given are changed.
  template <class Change>
  void expectRefusedWith(Change change, const std::string& words) {
    json changed = json_;
    change(changed);
    expectHeaderRefused(changed.dump(), words);
  }
  json& set(json& header) const { return header["tally_sets"][0]; }

  TempFolder folder_;
  test::MadeUpPart part_;
  std::filesystem::path path_;
  std::string bytes_;
  json json_;
  std::optional<ExrRows> rows_;
};

TEST_F(HostilePart, EveryTruncationIsRefused) {
  for (std::size_t size = bytes_.size() - 1;; size -= size > rows_->head().size() + 500 ? 397 : 1) {
    std::filesystem::resize_file(path_, size);
    ASSERT_NE(refusalOf(path_), "") << size;
    if (size == 0) break;
  }
}

TEST_F(HostilePart, ATruncationTellsHowMuchThereIs) {
  std::filesystem::resize_file(path_, bytes_.size() - 1);
  EXPECT_THAT(refusalOf(path_), HasSubstr("cut short: it has " + std::to_string(bytes_.size() - 1) + " of " +
                                          std::to_string(bytes_.size())));
  std::filesystem::resize_file(path_, 500);
  EXPECT_THAT(refusalOf(path_), HasSubstr("cut short"));
}

TEST_F(HostilePart, EveryFlippedByteIsRefused) {
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  const auto put = [&](std::size_t at, char byte) {
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte).flush();
  };
  const std::size_t dense = rows_->head().size() + 40, seal = bytes_.size() - kSealBytes;
  const auto inRowHead = [&](std::size_t at) {
    return (at >= rowAt(PartLayer::light) && at < rowAt(PartLayer::light) + 16) ||
           (at >= rowAt(PartLayer::statistics) && at < rowAt(PartLayer::statistics) + 16);
  };
  std::size_t flipped = 0;
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    if (at >= dense && at < seal && at % 151 != 0 && !inRowHead(at)) continue;
    put(at, static_cast<char>(bytes_[at] ^ (1 << (at % 8))));
    ASSERT_NE(refusalOf(path_), "") << "byte " << at << " of " << bytes_.size();
    put(at, bytes_[at]);
    ++flipped;
  }
  EXPECT_GT(flipped, dense);
  EXPECT_EQ(refusalOf(path_), "");
}

TEST_F(HostilePart, AnAlteredTallyIsRefusedEvenUnderAFreshSeal) {
  const std::size_t places[] = {rowAt(PartLayer::scene) + 20,
                                rowAt(PartLayer::light) + ExrRows::kRowHeadBytes + kPartWidth * 4,
                                rowAt(PartLayer::statistics) + ExrRows::kRowHeadBytes + kPartWidth * 4};
  for (const std::size_t at : places) {
    std::string altered = bytes_;
    altered[at] = static_cast<char>(altered[at] ^ 1);
    setBytes(path_, test::resealed(altered));
    EXPECT_THAT(refusalOf(path_), HasSubstr("altered")) << at;
  }
  setBytes(path_, test::resealed(bytes_));
  EXPECT_EQ(refusalOf(path_), "");
}

TEST_F(HostilePart, ANegativeTallyThatTheHashesBearOutIsRefused) {
  Tallies negative = test::madeUpTallies(10, 7, 0);
  negative.light()[2] = -1;  // blue, the first channel of a row
  const std::size_t at = rowAt(PartLayer::light) + ExrRows::kRowHeadBytes;
  bytes_.replace(at, 4, "\xff\xff\xff\xff");
  bytes_.replace(at + kPartWidth * 4, 4, "\xff\xff\xff\xff");
  bytes_.replace(bytes_.find(part_.tallies.contentHash().hex()), 32, negative.contentHash().hex());
  setBytes(path_, test::resealed(bytes_));
  EXPECT_EQ(refusalOf(path_), "") << "the hashes agree";
  Tallies sum(10, 7);
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { addPart(PartReader(path_), sum); }), HasSubstr("negative"));
}

TEST_F(HostilePart, BytesBehindTheSealAreRefused) {
  for (const std::size_t count : {1u, 24u, 70'000u}) {
    setBytes(path_, bytes_ + std::string(count, '\0'));
    EXPECT_THAT(refusalOf(path_), HasSubstr(std::to_string(count) + " bytes too many"));
  }
}

TEST_F(HostilePart, MadeUpSizesAreRefusedBeforeAnythingOfThatSizeIsMade) {
  const std::uint64_t before = peakMemoryBytes();
  for (const std::uint64_t size : {std::uint64_t{100'000'000}, std::uint64_t{1} << 40, std::uint64_t{1} << 61,
                                   (std::uint64_t{1} << 63) - 1, std::numeric_limits<std::uint64_t>::max()}) {
    expectRefusedWith([&](json& h) { h["scene_bytes"] = size; }, "cut short");
    expectRefusedWith([&](json& h) { set(h)["light_entries"] = size; }, "cut short");
    expectRefusedWith([&](json& h) { set(h)["texels"] = size; }, "cut short");
  }
  EXPECT_LT(peakMemoryBytes() - before, std::uint64_t{100} << 20);
}

TEST_F(HostilePart, AHeaderThatClaimsToBeLongerThanTheFileIsRefused) {
  for (const std::uint32_t length :
       {std::uint32_t{200'000}, std::uint32_t{1} << 28, std::uint32_t{0x7fffffff}, std::uint32_t{0xffffffff}}) {
    std::string altered = bytes_;
    std::memcpy(altered.data() + 8 + sizeof("lucarne") + sizeof("string"), &length, sizeof(length));
    setBytes(path_, altered);
    EXPECT_THAT(refusalOf(path_), HasSubstr("cut short")) << length;
  }
}

TEST_F(HostilePart, TextsThatAreNoHeadersAreRefused) {
  expectHeaderRefused("", "not a part");
  expectHeaderRefused("{", "JSON");
  expectHeaderRefused("nonsense", "JSON");
  expectHeaderRefused("null", "object");
  expectHeaderRefused("[]", "object");
  expectHeaderRefused("{}", "format is missing");
  expectHeaderRefused(std::string(100'000, '['), "nested");
  expectHeaderRefused(R"({"format":)" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}", "nested");
  expectHeaderRefused("{\"format\":\"\xff\xfe\"}", "JSON");
  expectHeaderRefused(R"({"format":"lucarne-part","version":1e400})", "JSON");
}

TEST_F(HostilePart, EveryMemberIsMissedAndOtherTypesAreRefused) {
  for (const auto& [key, value] : json_.items()) {
    expectRefusedWith([&, k = key](json& h) { h.erase(k); }, key);
    for (const json& other : {json(), json(true), json(-1.5), json("x"), json::array({json::array()}), json{{"a", 1}}})
      expectRefusedWith([&, k = key](json& h) { h[k] = other; }, "x.part");
  }
  for (const auto& [key, value] : json_["tally_sets"][0].items()) {
    expectRefusedWith([&, k = key](json& h) { set(h).erase(k); }, "x.part");
    for (const json& other : {json(), json(true), json(-1.5), json("x"), json::array({json::array()}), json{{"a", 1}}})
      expectRefusedWith([&, k = key](json& h) { set(h)[k] = other; }, "x.part");
  }
}

TEST_F(HostilePart, OtherVersionsAndTallySetsAreRefused) {
  expectRefusedWith([](json& h) { h["format"] = "lucarne-dlm"; }, "format is not that of a part");
  for (const int version : {3, 5})
    expectRefusedWith([&](json& h) { h["version"] = version; }, "version is one that this program does not know");
  expectRefusedWith([](json& h) { h["version"] = 0; }, "version");
  expectRefusedWith([this](json& h) { set(h)["name"] = "moments"; }, "tallies that this program does not know");
  expectRefusedWith([](json& h) { h["tally_sets"].push_back(h["tally_sets"][0]); },
                    "tallies that this program does not know");
  expectRefusedWith([](json& h) { h["tally_sets"] = json::array(); }, "tallies that this program does not know");
  expectRefusedWith([this](json& h) { set(h)["fixed_point_bits"] = 23; }, "does not know");
  expectRefusedWith([this](json& h) { set(h)["normaliser"] = 251; }, "does not know");
  expectRefusedWith([](json& h) { h["another"] = 1; }, "does not know");
}

TEST_F(HostilePart, SettingsThatTheirHashDoesNotBearOutAreRefused) {
  expectRefusedWith([](json& h) { h["settings"]["seed"] = 8; }, "settings was altered");
  expectRefusedWith([](json& h) { h["settings"]["more"] = json::array({1}); },
                    "settings must be an object of plain values");
  expectRefusedWith([](json& h) { h["resolve"]["more"] = json::object(); },
                    "resolve must be an object of plain values");
}

TEST_F(HostilePart, RangesThatAreNoSetAreRefused) {
  for (const char* ranges :
       {"[[10,5]]", "[[5,5]]", "[[0,10],[5,20]]", "[[10,20],[0,5]]", "[[0,10],[0,10]]", "[[0,10,20]]", "[[0]]", "[7]",
        "[[-1,250]]", "[[0,250.0]]", "[[0,18446744073709551616]]", "[[\"0\",\"250\"]]"})
    expectRefusedWith([&](json& h) { set(h)["ranges"] = json::parse(ranges); }, "ranges");
  // The same photons, but not as we write them.
  expectRefusedWith([&](json& h) { set(h)["ranges"] = json::parse("[[0,100],[100,250]]"); }, "x.part");
}

TEST_F(HostilePart, ALedgerOfAnotherNumberOfPhotonsIsRefused) {
  expectRefusedWith([this](json& h) { set(h)["ledger"]["photons"] = 249; }, "ledger is of another number of photons");
  expectRefusedWith([this](json& h) { set(h)["ranges"] = json::parse("[[0,251]]"); },
                    "ledger is of another number of photons");
}

TEST_F(HostilePart, AHeaderInAnotherWritingIsRefused) {
  const std::string members = R"("planned":{"parts":4,"photons":1000})",
                    swapped = R"("planned":{"photons":1000,"parts":4})";
  bytes_.replace(bytes_.find(members), members.size(), swapped);
  setBytes(path_, test::resealed(bytes_));
  EXPECT_THAT(refusalOf(path_), HasSubstr("altered"));
}

TEST_F(HostilePart, OtherFilesAreNoParts) {
  EXPECT_TRUE(isPart(path_));
  for (const std::string& text : {std::string("hello"), std::string("v/1\x01\x02\0\0\0channels", 16),
                                  std::string(100'000, 'x'), bytes_.substr(1)}) {
    setBytes(path_, text);
    EXPECT_THAT(refusalOf(path_), HasSubstr("not a part"));
    EXPECT_FALSE(isPart(path_));
  }
  setBytes(path_, "");
  EXPECT_NE(refusalOf(path_), "");
  EXPECT_FALSE(isPart(path_));
  EXPECT_FALSE(isPart(folder_.path()));
  EXPECT_FALSE(isPart(folder_ / "none"));
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { PartReader(folder_ / "none"); }), HasSubstr("none"));
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { PartReader(folder_.path()); }), HasSubstr(folder_.path().string()));
}

}  // namespace
}  // namespace lucarne::part_file_hostile_test
