#include "base/progress.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lucarne::progress_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A screen and a clock for a ProgressLine.
struct Stage {
  double now = 100;
  std::vector<std::string> written;

  ProgressOutput output(bool isTerminal, int columns = 0, bool json = false) {
    return {[this](const std::string& text) { written.push_back(text); }, [this] { return now; }, isTerminal, columns,
            json};
  }
};

ProgressGoal goalOf(std::uint64_t photons) { return {photons, {}, 0}; }

TEST(ProgressLine, ShowsShareAmountRatesAndTimeLeft) {
  Stage stage;
  ProgressLine line("baking", goalOf(20'000'000), false, stage.output(true));
  stage.now += 10;
  line.update(5'000'000, 15'000'000);
  ASSERT_EQ(stage.written.size(), 1u);
  EXPECT_EQ(stage.written[0],
            "\rbaking [#####               ]  25 %  5M of 20M photons  500k photons/s  1.5M rays/s  0:30 left");
}

TEST(ProgressLine, WritesAtMostFiveTimesASecondOnATerminal) {
  Stage stage;
  ProgressLine line("baking", goalOf(1000), false, stage.output(true));
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    stage.now += 0.01;
    line.update(i, i);
  }
  EXPECT_LE(stage.written.size(), 50u);
  EXPECT_GE(stage.written.size(), 45u);
}

TEST(ProgressLine, WritesALineAMinuteAndALastOneInALogFile) {
  Stage stage;
  {
    ProgressLine line("baking", goalOf(1000), false, stage.output(false));
    for (std::uint64_t i = 1; i <= 300; ++i) {
      stage.now += 1;
      line.update(i, 2 * i);
    }
    EXPECT_EQ(stage.written.size(), 5u);
    line.finish();
    line.finish();
    line.update(400, 400);
  }
  ASSERT_EQ(stage.written.size(), 6u);
  for (const std::string& text : stage.written) {
    EXPECT_TRUE(text.ends_with('\n'));
    EXPECT_THAT(text, Not(HasSubstr("\r")));
  }
  EXPECT_EQ(stage.written[5], "baking  30 %  300 of 1000 photons  1 photons/s  2 rays/s  5 min\n");
}

TEST(ProgressLine, IsSilentWhenQuiet) {
  Stage stage;
  {
    ProgressLine line("baking", goalOf(1000), true, stage.output(true));
    stage.now += 1000;
    line.update(10, 10);
    line.finish();
  }
  EXPECT_TRUE(stage.written.empty());
}

TEST(ProgressLine, TimeLeftFollowsAChangedRateSmoothly) {
  Stage stage;
  ProgressLine line("baking", goalOf(1'000'000), false, stage.output(true));
  std::uint64_t done = 0;
  for (int i = 0; i < 100; ++i, stage.now += 1) line.update(done += 100, 0);
  line.update(done += 1000, 0);  // a single burst within the last second
  stage.now += 1;
  line.update(done += 100, 0);
  const auto rateOf = [](const std::string& text) { return std::stod(text.substr(text.find("photons  ") + 9)); };
  EXPECT_GT(rateOf(stage.written.back()), 100);
  EXPECT_LT(rateOf(stage.written.back()), 200);
  for (int i = 0; i < 200; ++i, stage.now += 1) line.update(done += 500, 0);
  EXPECT_NEAR(rateOf(stage.written.back()), 500, 5);
}

TEST(ProgressLine, ShowsErrorsAndTheNextState) {
  Stage stage;
  ProgressLine line("baking", goalOf(4'000'000), false, stage.output(true));
  stage.now += 10;
  line.estimated(0.02, 1'000'000);
  line.update(1'000'000, 3'000'000, 290);
  EXPECT_EQ(stage.written.back(),
            "\rbaking [#####               ]  25 %  1M of 4M photons  100k photons/s  300k rays/s  "
            "error 2 %, 1 % at the end  0:30 left  state in 4:50");
}

TEST(ProgressLine, LeavesTheLeastImportantOutOnANarrowTerminal) {
  for (const int columns : {30, 60, 80, 100, 200}) {
    Stage stage;
    ProgressLine line("baking", goalOf(4'000'000), false, stage.output(true, columns));
    stage.now += 10;
    line.estimated(0.02, 1'000'000);
    line.update(1'000'000, 3'000'000, 290);
    const std::string& text = stage.written.back();
    EXPECT_LE(text.size(), static_cast<std::size_t>(columns));
    EXPECT_THAT(text, HasSubstr(" 25 %  1M of"));
    EXPECT_EQ(text.find("0:30 left") != std::string::npos, columns >= 60) << text;
    EXPECT_EQ(text.find("at the end") != std::string::npos, columns >= 80) << text;
  }
}

TEST(ProgressLine, JsonIsAnObjectALineOnceASecond) {
  Stage stage;
  ProgressLine line("baking", goalOf(1000), false, stage.output(false, 0, true));
  for (std::uint64_t i = 1; i <= 100; ++i) {
    stage.now += 0.1;
    line.update(5 * i, 15 * i, -1);
  }
  line.estimated(0.02, 500);
  line.finish();
  EXPECT_GE(stage.written.size(), 10u);
  EXPECT_LE(stage.written.size(), 11u);
  for (const std::string& text : stage.written) {
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    const auto object = nlohmann::json::parse(text);
    for (const char* key :
         {"phase", "seconds", "photons", "total_photons", "fraction", "photons_per_second", "rays_per_second",
          "seconds_left", "estimated_relative_error", "expected_relative_error", "seconds_to_checkpoint"})
      EXPECT_TRUE(object.contains(key)) << key;
  }
  const auto last = nlohmann::json::parse(stage.written.back());
  EXPECT_EQ(last["phase"], "traced");
  EXPECT_EQ(last["photons"], 500);
  EXPECT_NEAR(last["seconds_left"].get<double>(), 10, 0.5);
  EXPECT_NEAR(last["expected_relative_error"].get<double>(), 0.02 / std::sqrt(2.0), 1e-6);
  EXPECT_TRUE(last["seconds_to_checkpoint"].is_null());
}

TEST(ProgressLine, GatheringIsShownBeforePhotons) {
  Stage stage;
  ProgressLine line("baking", goalOf(1000), false, stage.output(false));
  stage.now += 61;
  line.updateGathering(16, 64);
  EXPECT_EQ(stage.written.back(), "gathering direct light  25 %  16 of 64 samples\n");
}

TEST(ProgressLine, RewritesLongerLinesAndEndsTheLineWhenAbandoned) {
  Stage stage;
  {
    ProgressLine line("baking", goalOf(0), false, stage.output(true));
    stage.now += 1;
    line.update(1'234'567, 7'654'321);
    stage.now += 1;
    line.update(20'000'000, 20'000'000);
  }
  ASSERT_EQ(stage.written.size(), 3u);
  EXPECT_GE(stage.written[1].size(), stage.written[0].size());
  EXPECT_THAT(stage.written[0], Not(HasSubstr("%")));
  EXPECT_EQ(stage.written[2], "\n");
}

TEST(ProgressLine, NeverWrapsAndSurvivesStandstillAndGoingBack) {
  Stage stage;
  ProgressLine line("baking", goalOf(1000), false, stage.output(true, 40));
  line.update(10, 10);
  stage.now += 1;
  line.update(10, 10);
  stage.now += 1;
  line.update(5, 5);
  for (const std::string& text : stage.written) EXPECT_LE(text.size(), 40u);  // a return and 39 columns
  EXPECT_EQ(stage.written.size(), 2u);
}

}  // namespace
}  // namespace lucarne::progress_test
