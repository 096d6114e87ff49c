// What ends a bake ends it at the same photon however it was run, and what the outside asks changes no bit.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "app/bake_scene.h"
#include "distributed/bake_job.h"
#include "distributed/ledger_state.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"
#include "tests/support/scene_builder.h"

namespace lucarne::stop_rules_test {
namespace {

constexpr std::uint64_t kFirst = 4096;
constexpr double kErrorOfOne = 10;  // of a made-up estimate that falls like 1/√photons

Scene room() {
  test::SceneBuilder s;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.8f, 0.7f, 0.6f}), true);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

class StopRule : public ::testing::Test {
 protected:
  StopRule()
      : scene_(room()),
        photonScene_(scene_),
        plan_(makePlan(scene_, options())),
        map_(scene_, plan_.charts, plan_.layout, plan_.tallies),
        bytes_(test::madeUpScene(1000)) {}

  static BakeOptions options() {
    BakeOptions o;
    o.texelsPerMetre = 2;
    return o;
  }
  static double errorAt(std::uint64_t photons) { return kErrorOfOne / std::sqrt(static_cast<double>(photons)); }

  BakeJob job(int threads, double target) const {
    BakeJob job{.task = {photonScene_, map_, plan_.tallies, plan_.directions},
                .run = runOptions(options()),
                .range = {0, 1'000'000'000},
                .scene = bytes_,
                .checkpointSeconds = 0,
                .progress = [](const RunProgress&) {}};
    job.run.threads = threads;
    job.rules.targetError = target;
    job.rules.firstJudged = kFirst;
    job.estimateError = [](const BakeState& s) { return errorAt(s.header.photons.count()); };
    return job;
  }
  BakeState nothingYet() const {
    PartHeader header = test::madeUpHeader({}, bytes_);
    header.ledger = {};
    return {std::move(header), Tallies(plan_.tallies)};
  }
  static void expectSame(const BakeState& a, const BakeState& b) {
    EXPECT_EQ(a.tallies.contentHash(), b.tallies.contentHash());
    EXPECT_EQ(ledgerState(a.header.ledger), ledgerState(b.header.ledger));
    EXPECT_EQ(toText(a.header.photons), toText(b.header.photons));
  }

  Scene scene_;
  PhotonScene photonScene_;
  BakePlan plan_;
  TexelMap map_;
  std::vector<std::uint8_t> bytes_;
};

TEST(StopRules, JudgedCountsGrowByAboutTheRootOfTwo) {
  const StopRules rules;
  EXPECT_EQ(rules.nextJudged(0), 1u << 20);
  std::uint64_t before = rules.firstJudged;
  EXPECT_TRUE(rules.isJudged(before));
  for (int i = 0; i < 80; ++i) {
    const std::uint64_t next = rules.nextJudged(before);
    EXPECT_NEAR(static_cast<double>(next) / static_cast<double>(before), std::sqrt(2.0), 0.001);
    EXPECT_TRUE(rules.isJudged(next));
    EXPECT_FALSE(rules.isJudged(next - 1));
    EXPECT_FALSE(rules.isJudged(next + 1));
    EXPECT_EQ(rules.nextJudged(next - 1), next);
    before = next;
  }
  EXPECT_GT(rules.nextJudged(~std::uint64_t{0} - 1), std::uint64_t{1} << 63);
}

TEST_F(StopRule, TheTargetEndsEveryBakeAtTheSamePhoton) {
  // Reached by 40,000 photons, so judged so at 46,336.
  const double target = errorAt(40'000) * 1.0001;
  BakeState one = nothingYet();
  EXPECT_EQ(runJob(job(1, target), one, nullptr).end, JobEnd::targetError);
  EXPECT_EQ(one.header.photons.count(), 181u << 8);
  EXPECT_LE(errorAt(one.header.photons.count()), target);
  for (const int threads : {2, 3}) {
    BakeState state = nothingYet();
    EXPECT_EQ(runJob(job(threads, target), state, nullptr).end, JobEnd::targetError);
    expectSame(state, one);
  }
}

TEST_F(StopRule, InterruptedAnywhereTheTargetEndsItAtTheSamePhoton) {
  const double target = errorAt(40'000);
  BakeState whole = nothingYet(), state = nothingYet();
  runJob(job(2, target), whole, nullptr);
  test::NumberStream random(3);
  int runs = 0;
  for (JobEnd end = JobEnd::interrupted; end == JobEnd::interrupted; ++runs) {
    std::atomic<std::uint64_t> asked{0};
    const std::uint64_t patience = 1 + random.upTo(40);
    BakeJob cut = job(1 + static_cast<int>(random.upTo(2)), target);
    cut.control.stop = [&] { return ++asked > patience; };
    end = runJob(cut, state, nullptr).end;
    ASSERT_LT(runs, 10'000);
  }
  EXPECT_GT(runs, 2);
  expectSame(state, whole);
}

TEST_F(StopRule, AStateAtAJudgedCountIsJudgedWhenItIsTakenUp) {
  const double target = errorAt(kFirst);
  BakeState state = nothingYet();
  BakeJob first = job(2, 0);
  first.range.end = kFirst;
  runJob(first, state, nullptr);
  EXPECT_EQ(runJob(job(2, target), state, nullptr).end, JobEnd::targetError);
  EXPECT_EQ(state.header.photons.count(), kFirst);
}

TEST_F(StopRule, LuckOfTheFirstPhotonsEndsNothing) {
  BakeJob lucky = job(2, 0.5);
  lucky.estimateError = [](const BakeState&) { return 0.0; };
  BakeState state = nothingYet();
  EXPECT_EQ(runJob(lucky, state, nullptr).end, JobEnd::targetError);
  EXPECT_EQ(state.header.photons.count(), kFirst);
}

TEST_F(StopRule, WhicheverComesFirst) {
  BakeState few = nothingYet();
  BakeJob photons = job(2, errorAt(40'000));
  photons.range.end = 10'000;
  EXPECT_EQ(runJob(photons, few, nullptr).end, JobEnd::photons);
  EXPECT_EQ(few.header.photons.count(), 10'000u);

  BakeState late = nothingYet();
  BakeJob time = job(2, 1e-9);
  time.rules.deadline = CheckpointClock::Clock::now();
  EXPECT_EQ(runJob(time, late, nullptr).end, JobEnd::time);
  EXPECT_GE(late.header.photons.count(), kFewestPhotons) << "no result is of nothing";
  EXPECT_LT(late.header.photons.count(), 100 * kFewestPhotons);
}

TEST_F(StopRule, AnAbandonedBatchIsABeginningWhoseRestIsTracedLater) {
  BakeState whole = nothingYet(), state = nothingYet();
  BakeJob all = job(3, 0);
  all.range.end = 60'000;
  runJob(all, whole, nullptr);
  for (int round = 0; state.header.photons.count() < 60'000; ++round) {
    std::atomic<int> asked{0};
    BakeJob cut = job(1 + round % 3, 0);
    cut.range.end = 60'000;
    cut.control.stop = [&] { return ++asked > 4 + round % 5; };
    const JobResult result = runJob(cut, state, nullptr);
    ASSERT_LE(state.header.photons.ranges().size(), 1u);
    if (result.end == JobEnd::photons) break;
    ASSERT_LT(round, 10'000);
  }
  expectSame(state, whole);
}

TEST_F(StopRule, PreviewsAreOfWholeTalliesAndChangeNothing) {
  BakeState whole = nothingYet(), state = nothingYet();
  BakeJob all = job(2, 0);
  all.range.end = 500'000;
  runJob(all, whole, nullptr);
  int previews = 0;
  BakeJob watched = all;
  watched.control.takePreview = [] { return true; };
  watched.preview = [&](BakeState& s) {
    ++previews;
    EXPECT_EQ(s.header.photons.count(), s.header.ledger.photons);
    BakeState same = nothingYet();
    BakeJob again = job(1, 0);
    again.range.end = s.header.photons.count();
    if (previews > 2) return;
    runJob(again, same, nullptr);
    expectSame(s, same);
  };
  runJob(watched, state, nullptr);
  EXPECT_GT(previews, 0);
  expectSame(state, whole);
}

TEST_F(StopRule, ProgressTellsOfCheckpointsToCome) {
  const TempFolder temp;
  CheckpointFolder folder(temp / "x.checkpoint");
  folder.open();
  BakeState state = nothingYet();
  BakeJob saving = job(1, 0);
  saving.range.end = 50'000;
  saving.checkpointSeconds = 1000;
  double least = 1e9, most = -1e9;
  saving.progress = [&](const JobProgress& p) {
    least = std::min(least, p.untilCheckpoint);
    most = std::max(most, p.untilCheckpoint);
  };
  EXPECT_TRUE(runJob(saving, state, &folder).saved);
  EXPECT_GT(least, 0);
  EXPECT_LE(most, 1000);
  saving.checkpointSeconds = 0;
  saving.range.end = 60'000;
  saving.progress = [](const JobProgress& p) { EXPECT_LT(p.untilCheckpoint, 0); };
  EXPECT_FALSE(runJob(saving, state, &folder).saved);
}

}  // namespace
}  // namespace lucarne::stop_rules_test
