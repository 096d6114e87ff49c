// Merging parts made by hand: any order and any tree gives the same sum, and what does not belong together is named.
#include "distributed/merge.h"

#include <gmock/gmock.h>

#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"

namespace lucarne::merge_test {
namespace {

namespace fs = std::filesystem;
using test::kMostTally;
using test::MadeUpPart;
using ::testing::AllOf;
using ::testing::HasSubstr;

void nothing(std::uint64_t) {}

/// Merges files to a part, as the program does.
void mergeTo(const fs::path& output, const std::vector<fs::path>& files) {
  const PartSet parts = joinParts(files);
  Tallies tallies(parts.whole.lightEntries, parts.whole.texels);
  const std::vector<std::uint8_t> scene = sumParts(parts, tallies, nothing);
  writePart(output, parts.whole, scene, tallies);
}

class MergeParts : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kLight = 2100, kTexels = 50;

  /// Part `number`, with photons that all others lack.
  fs::path write(std::uint64_t number) {
    const fs::path path = folder_ / ("p" + std::to_string(number) + ".part");
    test::madeUpPart({number * 100, number * 100 + 60 + 20 * (number % 3)}, kLight, kTexels, 100, number).write(path);
    return path;
  }
  /// A part of the same bake, changed.
  template <class Change>
  fs::path writeChanged(const std::string& name, Change change) {
    MadeUpPart part = test::madeUpPart({5000, 5010}, kLight, kTexels, 100, 77);
    change(part);
    part.write(folder_ / name);
    return folder_ / name;
  }
  std::string refusal(const std::vector<fs::path>& files, const std::set<std::string>& chosen = {}) {
    return errorOf(ExitCode::mergeRefused, [&] { joinParts(files, chosen); });
  }

  TempFolder folder_;
};

TEST_F(MergeParts, TheSumIsThatOfAllTallies) {
  std::vector<fs::path> files;
  Tallies expected(kLight, kTexels);
  for (std::uint64_t i = 0; i < 4; ++i) {
    files.push_back(write(i));
    expected.add(test::madeUpPart({0, 1}, kLight, kTexels, 100, i).tallies);
  }
  mergeTo(folder_ / "all.part", files);
  const PartHeader whole = PartReader(folder_ / "all.part").header();
  EXPECT_EQ(whole.content, expected.contentHash());
  EXPECT_EQ(toText(whole.photons), "0..60, 100..180, 200..360");  // 200..300 and 300..360 touch
  EXPECT_EQ(whole.ledger.photons, 60u + 80 + 100 + 60);
  EXPECT_EQ(whole.makers.size(), 3u);
}

TEST_F(MergeParts, AnyOrderAndAnyTreeGivesTheSameFile) {
  std::vector<fs::path> files;
  for (std::uint64_t i = 0; i < 7; ++i) files.push_back(write(i));
  mergeTo(folder_ / "whole.part", files);
  const std::string whole = test::bytesOf(folder_ / "whole.part");
  test::NumberStream random(11);
  for (int round = 0; round < 8; ++round) {
    std::vector<fs::path> left = files;
    for (int node = 0; left.size() > 1; ++node) {
      for (std::size_t i = left.size(); i > 1; --i) std::swap(left[i - 1], left[random.upTo(i - 1)]);
      const auto taken = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(left.size(), 1 + random.upTo(3)));
      const fs::path out = folder_ / ("node" + std::to_string(round) + "-" + std::to_string(node) + ".part");
      mergeTo(out, {left.begin(), left.begin() + taken});
      left.erase(left.begin(), left.begin() + taken);
      left.push_back(out);
    }
    EXPECT_TRUE(test::bytesOf(left[0]) == whole) << round;
  }
}

TEST_F(MergeParts, OneFileIsItsOwnSum) {
  const fs::path file = write(3);
  mergeTo(folder_ / "copy.part", {file});
  EXPECT_TRUE(test::bytesOf(folder_ / "copy.part") == test::bytesOf(file));
}

TEST_F(MergeParts, PartsOfDifferentPlansAreTheLargestPlan) {
  const auto planned = [&](const std::string& name, IndexRange photons, BakePlanned plan) {
    return writeChanged(name, [&](MadeUpPart& p) {
      p.header.photons = IndexSet(photons);
      p.header.ledger.photons = photons.size();
      p.header.planned = plan;
    });
  };
  std::vector<fs::path> files = {planned("a.part", {0, 10}, {1000, 4}), planned("b.part", {10, 20}, {2000, 0}),
                                 planned("c.part", {20, 30}, {1000, 4})};
  for (int i = 0; i < 6; ++i) {
    EXPECT_TRUE(joinParts(files).whole.planned == (BakePlanned{2000, 0})) << i;
    std::next_permutation(files.begin(), files.end());
  }
  EXPECT_TRUE(joinParts({files[0], files[2]}).whole.planned == (BakePlanned{1000, 4}));
}

TEST_F(MergeParts, BothFilesAndTheFieldAreNamed) {
  const fs::path a = write(1), good = write(2);
  const auto expectNamed = [&](const std::string& name, const auto& change, const std::string& words) {
    const fs::path b = writeChanged(name, change);
    EXPECT_THAT(refusal({a, b}), AllOf(HasSubstr(a.string()), HasSubstr(b.string()), HasSubstr("differ in " + words)));
    EXPECT_THAT(refusal({a, good, b}), AllOf(HasSubstr(b.string()), HasSubstr("differ in " + words)));
    EXPECT_THAT(refusal({b, a}), HasSubstr("differ in " + words.substr(0, words.find(':'))));
  };
  expectNamed(
      "seed.part", [](MadeUpPart& p) { p.header.identity.settings["seed"] = 8; }, "seed: 7 and 8");
  expectNamed(
      "more.part", [](MadeUpPart& p) { p.header.identity.settings["aaa"] = 1; }, "aaa: nothing and 1");
  expectNamed(
      "less.part", [](MadeUpPart& p) { p.header.identity.settings.erase("light"); }, "light: \"all\" and nothing");
  expectNamed(
      "kernel.part", [](MadeUpPart& p) { p.header.identity.resolve["kernel"] = "box"; },
      "kernel: \"pyramid\" and \"box\"");
  expectNamed(
      "layout.part", [](MadeUpPart& p) { p.header.identity.layout.hi ^= 1; }, "layout: ");
  expectNamed(
      "flux.part", [](MadeUpPart& p) { p.header.identity.emittedFlux *= 2; }, "emitted_flux_lm: ");
  expectNamed(
      "scene.part",
      [](MadeUpPart& p) {
        p.scene.push_back(1);
        p.header.identity.scene = hashBytes(p.scene);
      },
      "scene: ");
  expectNamed(
      "size.part", [](MadeUpPart& p) { p.tallies = test::madeUpTallies(kLight + 1, kTexels, 1); },
      "size of their tallies");
}

TEST_F(MergeParts, AnotherKernelMattersOnlyWhenTheMapsAreMadeWithIt) {
  const fs::path a = write(1),
                 b = writeChanged("kernel.part", [](MadeUpPart&p) { p.header.identity.resolve["kernel_width"] = 2; });
  EXPECT_THAT(refusal({a, b}), HasSubstr("kernel_width: 1.5 and 2"));
  EXPECT_NO_THROW(joinParts({a, b}, {"kernel", "kernel_width"}));
}

TEST_F(MergeParts, PhotonsThatTwoPartsHoldAreNamedWithBoth) {
  const fs::path a = write(1), b = write(2), c = write(3);  // 100..180, 200..300, 300..360
  EXPECT_THAT(refusal({a, a}), HasSubstr("p1.part and " + a.string() + " both hold photons 100..180"));
  const fs::path overlap = writeChanged("o.part", [](MadeUpPart& p) {
    p.header.photons = IndexSet({150, 160});
    p.header.photons.add({290, 310});
    p.header.ledger.photons = 30;
  });
  EXPECT_THAT(refusal({c, b, a, overlap}),
              AllOf(HasSubstr(c.string() + " and " + overlap.string()), HasSubstr("both hold photons 300..310")));
  EXPECT_THAT(refusal({b, overlap}), HasSubstr("p2.part and " + overlap.string() + " both hold photons 290..300"));
}

TEST_F(MergeParts, WhatThisPartAndTheNamedOneShareIsWhatTheRefusalSays) {
  const fs::path b = write(2), c = write(3);
  const fs::path overlap = writeChanged("o.part", [](MadeUpPart& p) {
    p.header.photons = IndexSet({290, 310});
    p.header.ledger.photons = 20;
  });
  // b holds 290..300, c 300..310: no one part holds 290..310 beside o.
  EXPECT_THAT(refusal({b, c, overlap}),
              HasSubstr(b.string() + " and " + overlap.string() + " both hold photons 290..300"));
}

TEST_F(MergeParts, SumsThatCouldOverflowAreRefusedFromTheHeadersAlone) {
  const auto incident = [&](const std::string& name, std::uint64_t at, Int128 units) {
    return writeChanged(name, [&](MadeUpPart& p) {
      p.header.photons = IndexSet({at, at + 10});
      p.header.ledger.photons = 10;
      p.header.ledger.incident.units[1] = units;
    });
  };
  const Int128 most = Int128{1} << 63;
  const fs::path half = incident("half.part", 0, most / 2), rest = incident("rest.part", 10, most / 2 - 1);
  const fs::path other = incident("other.part", 20, most / 2);
  EXPECT_NO_THROW(joinParts({half, rest}));
  EXPECT_THAT(errorOf(ExitCode::outOfResource, [&] { joinParts({half, other}); }), HasSubstr("tallies are full"));
  EXPECT_THAT(errorOf(ExitCode::outOfResource, [&] { joinParts({half, rest, other}); }), HasSubstr(other.string()));
}

TEST_F(MergeParts, DamageIsFoundWhileSummingAndWhileVerifying) {
  const fs::path a = write(1), b = write(2);
  const PartSet parts = joinParts({a, b});
  std::string bytes = test::bytesOf(b);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  test::setBytes(b, bytes);
  EXPECT_THAT(errorOf(ExitCode::mergeRefused, [&] { verifyParts(parts, nothing); }),
              HasSubstr(b.string() + " was altered"));
  Tallies tallies(kLight, kTexels);
  EXPECT_THAT(errorOf(ExitCode::mergeRefused, [&] { sumParts(parts, tallies, nothing); }),
              HasSubstr(b.string() + " was altered"));
  test::setBytes(b, "gone");
  EXPECT_THAT(refusal({a, b}), HasSubstr(b.string() + " is not a part"));
}

TEST_F(MergeParts, AFileExchangedAfterItsHeaderWasReadIsNoticed) {
  const fs::path a = write(1), b = write(2);
  const PartSet parts = joinParts({a, b});
  fs::copy_file(write(3), b, fs::copy_options::overwrite_existing);
  EXPECT_THAT(errorOf(ExitCode::mergeRefused, [&] { verifyParts(parts, nothing); }),
              HasSubstr(b.string() + " was exchanged"));
}

TEST_F(MergeParts, ProgressCountsAllBytesOnce) {
  const PartSet parts = joinParts({write(1), write(2), write(3)});
  std::vector<std::uint64_t> seen;
  verifyParts(parts, [&](std::uint64_t bytes) { seen.push_back(bytes); });
  const std::uint64_t each = parts.whole.tallyBytes() + parts.whole.sceneBytes;
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{each, 2 * each, 3 * each}));
}

TEST_F(MergeParts, NoPartsAndMissingPartsAreToldApart) {
  errorOf(ExitCode::usage, [] { joinParts({}); });
  EXPECT_THAT(errorOf(ExitCode::badInput, [&] { joinParts({folder_ / "none.part"}); }), HasSubstr("none.part"));
}

TEST(MakersWarning, NamesEachKindOfRaysOnce) {
  const Maker a{"one", "Embree", "cpu", {1, 1}}, b{"two", "Embree", "cpu", {1, 1}},
      c{"three", "Embree", "other cpu", {2, 2}};
  EXPECT_EQ(makersWarning({}), "");
  EXPECT_EQ(makersWarning({a, b}), "");
  const std::string text = makersWarning({a, b, c});
  EXPECT_THAT(text, AllOf(HasSubstr("2 kinds"), HasSubstr("three on other cpu"), HasSubstr("one on cpu")));
  EXPECT_EQ(text.find("two on cpu"), std::string::npos);
}

TEST(Difference, IsEmptyForOneBakeAndNamesTheFirstDifferenceElse) {
  const std::vector<std::uint8_t> scene = test::madeUpScene(10);
  const BakeIdentity a = test::madeUpHeader({}, scene).identity;
  BakeIdentity b = a;
  EXPECT_EQ(difference(a, b), "");
  EXPECT_EQ(a.settingsHash(), b.settingsHash());
  b.resolve["kernel"] = "box";
  EXPECT_EQ(difference(a, b, {"kernel", "kernel_width"}), "");
  EXPECT_EQ(difference(a, b), "kernel: \"pyramid\" and \"box\"");
  b.settings["texels_per_metre"] = 8;
  EXPECT_EQ(difference(a, b), "texels_per_metre: 16.5 and 8");
  EXPECT_NE(a.settingsHash(), b.settingsHash());
  b.settings["light"] = "direct";
  EXPECT_EQ(difference(a, b), "light: \"all\" and \"direct\"");
  EXPECT_EQ(difference(b, a), "light: \"direct\" and \"all\"");
  b.scene = {};
  EXPECT_EQ(difference(a, b), "scene: " + a.scene.hex().substr(0, 8) + " and 00000000");
}

}  // namespace
}  // namespace lucarne::merge_test
