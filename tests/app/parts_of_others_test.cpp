// Parts and states of other programs and processors: merged with a warning that says what it means, never gone on with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/bake.h"
#include "app/merge.h"
#include "base/error.h"
#include "distributed/merge.h"

namespace lucarne::parts_of_others_test {
namespace {

namespace fs = std::filesystem;

class PartsOfOthers : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("lucarne_others_") + info->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  BakeOptions options(const std::string& output) const {
    BakeOptions o;
    o.scene = LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb";
    o.output = folder_ / output;
    o.photons = 20'000;
    o.texelsPerMetre = 10;
    o.quiet = true;
    return o;
  }

  /// Part k of 2, as if `change` had been true of its maker.
  fs::path bakePart(std::uint64_t k, const std::function<void(Maker&)>& change) const {
    BakeOptions o = options("part" + std::to_string(k) + ".part");
    o.part = PartNumber{k, 2};
    bake(o);
    rewrite(o.output, o.output, change);
    return o.output;
  }

  static void rewrite(const fs::path& from, const fs::path& to, const std::function<void(Maker&)>& change) {
    const PartReader part(from);
    PartHeader header = part.header();
    Tallies tallies(header.lightEntries, header.texels);
    std::vector<std::uint8_t> scene;
    addPart(part, tallies, &scene);
    Maker maker = *header.makers.begin();
    change(maker);
    header.makers = {maker};
    writePart(to, header, scene, tallies);
  }

  fs::path folder_;
};

TEST_F(PartsOfOthers, WhoseRaysDifferMergeWithAWarningThatSaysWhatItMeans) {
  const fs::path a = bakePart(1, [](Maker&) {}), b = bakePart(2, [](Maker&m) {
                                                   m.processor = "Other CPU";
                                                   m.probeRays.lo ^= 1;
                                                 });
  const PartSet parts = joinParts({a, b});
  const std::string warning = makersWarning(parts.whole.makers);
  EXPECT_THAT(warning, testing::HasSubstr("Other CPU"));
  EXPECT_THAT(warning, testing::HasSubstr("no single machine would give the same bits"));
  MergeOptions merging;
  merging.inputs = {a.string(), b.string()};
  merging.output = folder_ / "merged.dlm";
  EXPECT_EQ(merge(merging)["photons"], 20'000);
}

TEST_F(PartsOfOthers, WhoseRaysAgreeMergeWithoutAWord) {
  const fs::path a = bakePart(1, [](Maker&) {}), b = bakePart(2, [](Maker&m) { m.processor = "Other CPU"; });
  EXPECT_EQ(makersWarning(joinParts({a, b}).whole.makers), "");
}

/// What bake() refuses when a state of a changed maker is all there is to go on with.
std::string refusal(const BakeOptions& options) {
  try {
    bake(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::mergeRefused);
    return error.what();
  }
  return "nothing";
}

TEST_F(PartsOfOthers, AStateOfAnotherBuildOrProcessorIsNotGoneOnWith) {
  BakeOptions half = options("half.part");
  half.photonRange = IndexRange{0, 10'000};
  bake(half);
  BakeOptions whole = options("room.part");
  whole.resume = true;
  fs::create_directories(folder_ / "room.checkpoint");
  const fs::path state = folder_ / "room.checkpoint" / "state-000001.part";
  rewrite(half.output, state, [](Maker& m) { m.build = "lucarne 9.9"; });
  EXPECT_THAT(refusal(whole), testing::HasSubstr("differ in build: "));
  rewrite(half.output, state, [](Maker& m) { m.probeRays.hi ^= 1; });
  EXPECT_THAT(refusal(whole), testing::HasSubstr("differ in probe_rays: "));
  EXPECT_TRUE(fs::exists(state)) << "what is refused is not touched";
  rewrite(half.output, state, [](Maker& m) { m.processor = "the same, renamed"; });
  bake(whole);
  BakeOptions undisturbed = options("undisturbed.part");
  bake(undisturbed);
  EXPECT_EQ(PartReader(whole.output).header().content, PartReader(undisturbed.output).header().content);
}

TEST_F(PartsOfOthers, AnotherLayoutOfTheSameSceneIsAnotherVersionOfLucarne) {
  const fs::path a = bakePart(1, [](Maker&) {}), b = bakePart(2, [](Maker&) {});
  const PartReader part(b);
  PartHeader header = part.header();
  header.identity.layout.lo ^= 1;
  Tallies tallies(header.lightEntries, header.texels);
  std::vector<std::uint8_t> scene;
  addPart(part, tallies, &scene);
  writePart(folder_ / "c.part", header, scene, tallies);
  MergeOptions merging;
  merging.inputs = {a.string(), (folder_ / "c.part").string()};
  merging.output = folder_ / "merged.dlm";
  try {
    merge(merging);
    FAIL() << "merged";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::mergeRefused);
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("part1.part and "), testing::HasSubstr("differ in layout"),
                               testing::HasSubstr("versions of Lucarne")));
  }
  EXPECT_FALSE(fs::exists(folder_ / "merged.dlm"));
}

}  // namespace
}  // namespace lucarne::parts_of_others_test
