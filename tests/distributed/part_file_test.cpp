// Parts come back as they were written, to the last bit, whatever their size.
#include "distributed/part_file.h"

#include <gmock/gmock.h>

#include "distributed/ledger_state.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"

namespace lucarne::part_file_test {
namespace {

using test::kMostTally;
using test::MadeUpPart;
using test::madeUpPart;
using ::testing::HasSubstr;

bool equal(const Tallies& a, const Tallies& b) {
  return std::ranges::equal(a.light(), b.light()) && std::ranges::equal(a.statistics(), b.statistics());
}

/// Header, scene and tallies are those written, and writing them again gives the same file.
void expectComesBack(const MadeUpPart& part, const TempFolder& folder) {
  const auto path = folder / "a.part";
  part.write(path);
  const PartReader reader(path);
  const PartHeader& h = reader.header();
  EXPECT_EQ(h.sceneBytes, part.scene.size());
  EXPECT_EQ(h.lightEntries * kLightChannels, part.tallies.light().size());
  EXPECT_EQ(h.texels * kStatisticsChannels, part.tallies.statistics().size());
  EXPECT_EQ(h.content, part.tallies.contentHash());
  PartHeader expected = part.header;
  expected.sceneBytes = h.sceneBytes;
  expected.sceneFile = h.sceneFile;
  expected.lightEntries = h.lightEntries;
  expected.texels = h.texels;
  expected.content = h.content;
  EXPECT_EQ(toJson(h), toJson(expected));
  Tallies tallies(h.lightEntries, h.texels);
  std::vector<std::uint8_t> scene;
  addPart(reader, tallies, &scene);
  EXPECT_TRUE(equal(tallies, part.tallies));
  EXPECT_EQ(scene, part.scene);
  writePart(folder / "b.part", h, scene, tallies);
  EXPECT_TRUE(test::bytesOf(path) == test::bytesOf(folder / "b.part"));
  EXPECT_TRUE(isPart(path));
}

TEST(PartFile, TalliesOfEverySizeComeBack) {
  const TempFolder folder;
  for (const std::uint64_t n : {0u, 1u, 2047u, 2048u, 2049u, 5000u}) {
    SCOPED_TRACE(n);
    expectComesBack(madeUpPart({5, 20}, n, 3, 10, n), folder);
    expectComesBack(madeUpPart({5, 20}, 3, n, 10, n), folder);
  }
}

TEST(PartFile, ScenesOfEverySizeComeBack) {
  const TempFolder folder;
  for (const std::size_t n : {0u, 1u, 3u, 4u, 5u, 8191u, 8192u, 8193u, 100'000u}) {
    SCOPED_TRACE(n);
    expectComesBack(madeUpPart({5, 20}, 4, 4, n, n), folder);
  }
}

TEST(PartFile, TheLargestTalliesComeBack) {
  const TempFolder folder;
  MadeUpPart part = madeUpPart({0, 1});
  part.tallies = test::madeUpTallies(3000, 2500, 9, kMostTally);
  part.tallies.light()[0] = part.tallies.statistics()[1] = kMostTally;
  part.tallies.light()[1] = std::int64_t{1} << 32;
  part.tallies.light()[2] = (std::int64_t{1} << 32) - 1;
  expectComesBack(part, folder);
}

TEST(PartFile, EveryKindOfHeaderComesBack) {
  const TempFolder folder;
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  MadeUpPart part = madeUpPart({0, 1});
  part.header.sceneName = "it's \"a\" \\ room\n\t√.glb";
  part.header.photons = IndexSet({3, 9});
  part.header.photons.add({kMost - 5, kMost});
  part.header.ledger.photons = part.header.photons.count();
  part.header.planned = {kMost, kMostParts};
  part.header.microseconds = kMost;
  part.header.identity.emittedFlux = 5e-324;
  part.header.identity.settings["seed"] = kMost;
  part.header.makers.insert({"another build", "", "", {kMost, 0}});
  expectComesBack(part, folder);
  part.header.ledger = {};  // of a scene without light
  expectComesBack(part, folder);
  part.header.makers.clear();
  expectComesBack(part, folder);
}

TEST(PartFile, AHeaderLongerThanTheFirstLookComesBack) {
  const TempFolder folder;
  MadeUpPart part = madeUpPart({0, 1});
  for (std::uint64_t i = 1; i < 20'000; ++i) part.header.photons.add({2 * i, 2 * i + 1});
  part.header.ledger.photons = part.header.photons.count();
  expectComesBack(part, folder);
}

TEST(PartFile, NamesThatAreNoUtf8AreWrittenReadably) {
  const TempFolder folder;
  MadeUpPart part = madeUpPart({0, 1});
  part.header.sceneName = "r\xf6om.glb";
  part.write(folder / "a.part");
  EXPECT_EQ(test::refusalOf(folder / "a.part"), "");
  EXPECT_EQ(PartReader(folder / "a.part").header().sceneName, "r\xEF\xBF\xBDom.glb");
}

TEST(PartFile, LedgersComeBackWithNegativeSumsOf128Bits) {
  Ledger ledger = test::madeUpLedger(1000, 3);
  const Int128 large = Int128{1} << 112;  // 34 digits
  ledger.emitted.units = {large, -large, 0};
  ledger.roulette.units = {-1, std::numeric_limits<std::int64_t>::min(), -large + 1};
  ledger.absorptionErrorSquares = large - 1;
  const nlohmann::json state = ledgerState(ledger);
  EXPECT_EQ(state["emitted"],
            (nlohmann::json{"5192296858534827628530496329220096", "-5192296858534827628530496329220096", "0"}));
  const Ledger again = ledgerFromState(JsonView(state, "file"));
  EXPECT_TRUE(again.emitted == ledger.emitted);
  EXPECT_TRUE(again.roulette == ledger.roulette);
  EXPECT_TRUE(again.absorptionErrorSquares == ledger.absorptionErrorSquares);
  EXPECT_EQ(ledgerState(again), state);
}

TEST(PartFile, LedgersWithOtherTextThanNumbersAreRefused) {
  const nlohmann::json good = ledgerState(test::madeUpLedger(1, 1));
  for (const char* text : {"", "-", "1.5", "1e3", " 1", "0x1", "99999999999999999999999999999999999"}) {
    nlohmann::json bad = good;
    bad["absorbed"][1] = text;
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { ledgerFromState(JsonView(bad, "x.part")); }),
                HasSubstr("absorbed[1]"))
        << text;
  }
  for (const auto& [key, value] : good.items()) {
    nlohmann::json bad = good;
    bad.erase(key);
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { ledgerFromState(JsonView(bad, "x.part")); }), HasSubstr(key));
    bad[key] = nullptr;
    EXPECT_THAT(errorOf(ExitCode::badInput, [&] { ledgerFromState(JsonView(bad, "x.part")); }), HasSubstr(key));
  }
}

TEST(PartFile, ANegativeTallyIsABrokenContractAndLeavesNoFile) {
  const TempFolder folder;
  for (const std::size_t at : {0u, 29u}) {
    MadeUpPart part = madeUpPart({0, 1});
    part.tallies.light()[at] = -1;
    EXPECT_THROW(part.write(folder / "a.part"), std::logic_error);
  }
  MadeUpPart part = madeUpPart({0, 1});
  part.tallies.statistics()[3] = std::numeric_limits<std::int64_t>::min();
  EXPECT_THROW(part.write(folder / "a.part"), std::logic_error);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(PartFile, SumsThatPass63BitsAreNoticed) {
  const TempFolder folder;
  const auto path = folder / "full.part";
  MadeUpPart part = madeUpPart({0, 1});
  part.tallies.light()[7] = kMostTally - 5;
  part.tallies.statistics()[13] = kMostTally;
  part.write(path);
  const PartReader reader(path);
  Tallies fits(10, 7);
  fits.light()[7] = 5;
  EXPECT_NO_THROW(addPart(reader, fits));
  EXPECT_EQ(fits.light()[7], kMostTally);
  Tallies light(10, 7), statistics(10, 7);
  light.light()[7] = 6;
  statistics.statistics()[13] = 1;
  for (Tallies* full : {&light, &statistics})
    EXPECT_THAT(errorOf(ExitCode::outOfResource, [&] { addPart(reader, *full); }), HasSubstr("full.part"));
  EXPECT_THROW(addPart(reader, fits), Error);
}

TEST(PartFile, TalliesOfAnotherSizeAreRefused) {
  const TempFolder folder;
  madeUpPart({0, 1}).write(folder / "a.part");
  const PartReader reader(folder / "a.part");
  Tallies narrow(9, 7), wide(10, 8);
  EXPECT_THROW(addPart(reader, narrow), PartError);
  EXPECT_THROW(addPart(reader, wide), PartError);
}

TEST(PartFile, WritingReplacesWholeFilesAndLeavesNothingBeside) {
  const TempFolder folder;
  madeUpPart({0, 1}, 5000).write(folder / "a.part");
  madeUpPart({1, 2}, 3).write(folder / "a.part");
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_EQ(PartReader(folder / "a.part").header().photons.ranges().front().begin, 1u);
  EXPECT_THROW(madeUpPart({0, 1}).write(folder / "no" / "such.part"), Error);
}

}  // namespace
}  // namespace lucarne::part_file_test
