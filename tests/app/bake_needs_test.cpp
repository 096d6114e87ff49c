// What a bake is predicted to take, and what is told to those for whom it is too much.
#include "app/bake_needs.h"

#include <gmock/gmock.h>

#include "app/bake_scene.h"
#include "base/disk.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/support/scene_builder.h"

namespace lucarne::bake_needs_test {
namespace {

using ::testing::HasSubstr;

constexpr MemorySoFar kSoFar{20'000'000, 25'000'000};

Scene room() {
  test::SceneBuilder s;
  Material glossy = test::diffuseMaterial({0.3f, 0.2f, 0.1f});
  glossy.specular = 1;
  glossy.roughness = 0.4f;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addMaterial(glossy), true);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

class BakeNeeds : public ::testing::Test {
 protected:
  BakeNeeds() : scene_(room()) {
    options_.texelsPerMetre = 60;
    options_.threads = 3;
    options_.output = "x.dlm";
  }
  std::uint64_t peakOf(const BakeOptions& o) const {
    return predictMemory(o, scene_, makePlan(scene_, o), kSoFar).peak();
  }
  /// The number that follows `word`.
  static double numberAfter(const std::string& text, const std::string& word) {
    const std::size_t at = text.find(word);
    EXPECT_NE(at, std::string::npos) << text;
    return at == std::string::npos ? 0 : std::stod(text.substr(at + word.size()));
  }

  Scene scene_;
  BakeOptions options_;
};

TEST_F(BakeNeeds, MoreOfEverythingTakesMore) {
  const std::uint64_t usual = peakOf(options_);
  BakeOptions finer = options_, wider = options_, gathered = options_, adaptive = options_;
  finer.texelsPerMetre = 90;
  wider.directions = 30;
  gathered.direct = DirectMode::gathered;
  adaptive.kernel.shape = KernelShape::adaptive;
  for (const BakeOptions& o : {finer, wider, gathered}) EXPECT_GT(peakOf(o), usual);
  EXPECT_GE(peakOf(adaptive), usual);
  EXPECT_GE(usual, kSoFar.peak);
}

TEST_F(BakeNeeds, ThreadsShareTheirTalliesBeforeABakeIsRefused) {
  const BakePlan plan = makePlan(scene_, options_);
  BakeOptions alone = options_;
  alone.ownTallies = false;
  const std::uint64_t usual = peakOf(options_), shared = peakOf(alone);
  ASSERT_LT(shared, usual);
  BakeOptions o = options_;
  EXPECT_EQ(requireMemory(o, scene_, plan, kSoFar, usual).peak(), usual);
  EXPECT_TRUE(o.ownTallies);
  EXPECT_EQ(requireMemory(o, scene_, plan, kSoFar, usual - 1).peak(), shared);
  EXPECT_FALSE(o.ownTallies);
}

TEST_F(BakeNeeds, WhatIsToldToFitFits) {
  const BakePlan plan = makePlan(scene_, options_);
  BakeOptions alone = options_;
  alone.ownTallies = false;
  const std::uint64_t shared = peakOf(alone);
  // Tallies are most of it: some density fits at each of these, and some number of directions at the first.
  for (const double share : {0.8, 0.6, 0.45}) {
    const auto allowed = static_cast<std::uint64_t>(share * static_cast<double>(shared));
    BakeOptions refused = options_;
    const std::string error =
        errorOf(ExitCode::outOfResource, [&] { requireMemory(refused, scene_, plan, kSoFar, allowed); });
    EXPECT_THAT(error, HasSubstr("would fit"));
    BakeOptions coarser = alone;
    coarser.texelsPerMetre = numberAfter(error, "--density ");
    EXPECT_LE(peakOf(coarser), allowed) << error;
    EXPECT_GT(coarser.texelsPerMetre, 0.3 * options_.texelsPerMetre) << "not less than needed by much: " << error;
    if (error.find("--directions ") == std::string::npos) continue;
    BakeOptions fewer = alone;
    fewer.directions = static_cast<int>(numberAfter(error, "--directions "));
    EXPECT_LE(peakOf(fewer), allowed) << error;
  }
  BakeOptions hopeless = options_;
  EXPECT_THAT(errorOf(ExitCode::outOfResource, [&] { requireMemory(hopeless, scene_, plan, kSoFar, 1'000'000); }),
              HasSubstr("no density would"));
}

TEST_F(BakeNeeds, TooLittleRoomOnTheDiskIsToldWithBothNumbers) {
  const TempFolder temp;
  options_.output = temp / "x.dlm";
  const std::uint64_t free = freeDiskBytes(options_.output).value();
  ASSERT_GT(free, 0u);
  EXPECT_NO_THROW(requireDisk(options_, {1000, 1000}, 0));
  const std::string error = errorOf(ExitCode::outOfResource, [&] {
    requireDisk(options_, {1000, std::uint64_t{1} << 60}, 0);
  });
  EXPECT_THAT(error, HasSubstr("need 2 EiB"));
  EXPECT_THAT(error, HasSubstr("are free"));
  EXPECT_NO_THROW(requireDisk(options_, {1000, std::uint64_t{1} << 60}, std::uint64_t{1} << 61)) << "they are there";
  options_.checkpointSeconds = 0;
  EXPECT_NO_THROW(requireDisk(options_, {1000, std::uint64_t{1} << 60}, 0)) << "no states are saved";
}

TEST(Disk, IsFoundOfPathsThatAreNotThereYet) {
  const TempFolder temp;
  EXPECT_TRUE(freeDiskBytes(temp / "a" / "b" / "c").has_value());
  EXPECT_TRUE(onSameDisk(temp / "a", temp / "b" / "c"));
  EXPECT_FALSE(onSameDisk(temp / "a", "/proc/self"));
}

}  // namespace
}  // namespace lucarne::bake_needs_test
