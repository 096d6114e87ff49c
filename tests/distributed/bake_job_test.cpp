// A bake cut into pieces, or resumed from any state of it, is the bake in one run: every tally and every number of the
// ledger.
#include "distributed/bake_job.h"

#include <gmock/gmock.h>

#include <fstream>

#include "app/bake_scene.h"
#include "distributed/ledger_state.h"
#include "distributed/probe_rays.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"
#include "tests/support/scene_builder.h"

namespace lucarne::bake_job_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr std::uint64_t kPhotons = 100'000;

Scene roomWith(float roughness) {
  test::SceneBuilder s;
  Material glossy = test::diffuseMaterial({0.3f, 0.2f, 0.1f});
  glossy.specular = 1;
  glossy.roughness = roughness;
  glossy.doubleSided = true;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.8f, 0.7f, 0.6f}), true);
  s.addBox({1, 0.2, 1}, {2, 1, 2.5}, s.addMaterial(glossy), false);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

/// A small room, ready to trace, and what its whole bake gives.
class BakeJobs : public ::testing::Test {
 protected:
  BakeJobs()
      : scene_(roomWith(0.4671f)),
        photonScene_(scene_),
        plan_(makePlan(scene_, options())),
        map_(scene_, plan_.charts, plan_.layout, plan_.tallies),
        bytes_(test::madeUpScene(1000)) {}

  static BakeOptions options() {
    BakeOptions o;
    o.texelsPerMetre = 3;
    o.seed = 5;
    return o;
  }
  BakeJob job(IndexRange range, int threads) const {
    PhotonRunOptions run = runOptions(options());
    run.threads = threads;
    return {.task = {photonScene_, map_, plan_.tallies, plan_.directions},
            .run = run,
            .range = range,
            .scene = bytes_,
            .checkpointSeconds = 0,
            .progress = [](const RunProgress&) {}};
  }
  BakeState nothingYet() const {
    PartHeader header = test::madeUpHeader({}, bytes_);
    header.ledger = {};
    return {std::move(header), Tallies(plan_.tallies)};
  }
  BakeState bakeWhole(int threads = 2) const {
    BakeState state = nothingYet();
    runJob(job({0, kPhotons}, threads), state, nullptr);
    return state;
  }
  BakeState load(const fs::path& file) const {
    const PartReader part(file);
    BakeState state{part.header(), Tallies(plan_.tallies)};
    addPart(part, state.tallies);
    return state;
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

TEST_F(BakeJobs, AnyCutWithAnyThreadsIsOneRun) {
  const BakeState whole = bakeWhole();
  EXPECT_TRUE(whole.header.ledger.balance() == whole.header.ledger.emitted);
  test::NumberStream random(4);
  for (int round = 0; round < 3; ++round) {
    BakeState sum = nothingYet();
    for (std::uint64_t at = 0; at < kPhotons;) {
      const std::uint64_t end = std::min(kPhotons, at + 1 + random.upTo(kPhotons / 2));
      BakeState piece = nothingYet();
      runJob(job({at, end}, 1 + static_cast<int>(random.upTo(2))), piece, nullptr);
      sum.header.add(piece.header);
      sum.tallies.add(piece.tallies);
      at = end;
    }
    expectSame(sum, whole);
  }
}

TEST_F(BakeJobs, AJobGoesOnWithWhatItsStateHas) {
  const BakeState whole = bakeWhole();
  BakeState state = nothingYet();
  test::NumberStream random(6);
  for (std::uint64_t end = 0; end < kPhotons;) {
    end = std::min(kPhotons, end + 1 + random.upTo(kPhotons / 3));
    runJob(job({0, end}, 1 + static_cast<int>(random.upTo(2))), state, nullptr);
    EXPECT_EQ(state.header.photons.count(), end);
  }
  expectSame(state, whole);
  runJob(job({0, kPhotons}, 1), state, nullptr);
  expectSame(state, whole);
}

TEST_F(BakeJobs, EverySavedStateGoesOnToTheSameEnd) {
  const BakeState whole = bakeWhole();
  const TempFolder temp;
  CheckpointFolder folder(temp / "x.checkpoint");
  folder.open();
  std::set<std::string> kept;
  // Keeps every state that is saved, also those that later ones replace.
  const auto keep = [&] {
    for (const auto& entry : fs::directory_iterator(folder.path()))
      if (entry.path().extension() == ".part" && kept.insert(entry.path().filename().string()).second)
        fs::copy_file(entry.path(), temp / entry.path().filename().string());
  };
  BakeState state = nothingYet();
  for (const std::uint64_t end : {std::uint64_t{1}, std::uint64_t{30'000}, std::uint64_t{70'001}, kPhotons}) {
    BakeJob saving = job({0, end}, 2);
    saving.checkpointSeconds = 0.001;
    saving.progress = [&](const RunProgress&) { keep(); };
    runJob(saving, state, &folder);
    keep();
  }
  expectSame(state, whole);
  EXPECT_GE(kept.size(), 4u);
  int threads = 0;
  for (const std::string& name : kept) {
    SCOPED_TRACE(name);
    BakeState resumed = load(temp / name);
    runJob(job({0, kPhotons}, 1 + threads++ % 3), resumed, nullptr);
    expectSame(resumed, whole);
  }
}

TEST_F(BakeJobs, WithoutATimeNothingIsSaved) {
  const TempFolder temp;
  CheckpointFolder folder(temp / "x.checkpoint");
  folder.open();
  BakeState state = nothingYet();
  runJob(job({0, 1000}, 1), state, &folder);
  EXPECT_FALSE(folder.peek().has_value());
}

TEST_F(BakeJobs, ADiskThatFailsCostsNoPhoton) {
  const TempFolder temp;
  CheckpointFolder folder(temp / "x.checkpoint");
  folder.open();
  fs::remove_all(folder.path());
  std::ofstream(folder.path()) << "in the way";
  BakeJob saving = job({0, kPhotons}, 2);
  saving.checkpointSeconds = 0.001;
  const BakeState whole = bakeWhole();
  BakeState state = nothingYet();
  EXPECT_FALSE(runJob(saving, state, &folder).saved);
  expectSame(state, whole);
  fs::remove(folder.path());
  EXPECT_TRUE(runJob(saving, state, &folder).saved) << "a folder that vanished is made again";
  EXPECT_TRUE(folder.peek().has_value());
}

TEST_F(BakeJobs, ProgressCountsEarlierRunsToo) {
  BakeState state = nothingYet();
  runJob(job({0, 10'000}, 1), state, nullptr);
  const std::uint64_t raysBefore = state.header.ledger.rays;
  std::vector<RunProgress> seen;
  BakeJob more = job({0, 50'000}, 1);
  more.progress = [&](const RunProgress& p) { seen.push_back(p); };
  runJob(more, state, nullptr);
  ASSERT_FALSE(seen.empty());
  EXPECT_GT(seen.front().photons, 10'000u);
  EXPECT_GT(seen.front().rays, raysBefore);
  EXPECT_EQ(seen.back().photons, 50'000u);
  EXPECT_EQ(seen.back().rays, state.header.ledger.rays);
}

TEST_F(BakeJobs, PhotonsAtTheEndOfAllNumbersAreTraced) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  BakeState whole = nothingYet(), cut = nothingYet();
  runJob(job({kMost - 20'000, kMost}, 2), whole, nullptr);
  EXPECT_EQ(whole.header.ledger.photons, 20'000u);
  for (const std::uint64_t end : {kMost - 20'000 + 1, kMost - 1, kMost})
    runJob(job({kMost - 20'000, end}, 3), cut, nullptr);
  expectSame(cut, whole);
}

TEST_F(BakeJobs, WhatIsNoBeginningOfTheRangeIsRefused) {
  BakeState state = nothingYet();
  EXPECT_EQ(remaining(state, {5, 50}, "f").begin, 5u);
  state.header.photons = IndexSet({10, 20});
  EXPECT_EQ(remaining(state, {10, 50}, "f").begin, 20u);
  EXPECT_EQ(remaining(state, {10, 20}, "f").size(), 0u);
  for (const IndexRange range :
       {IndexRange{10, 19}, IndexRange{0, 50}, IndexRange{11, 50}, IndexRange{20, 30}, IndexRange{0, 5}})
    EXPECT_THAT(errorOf(ExitCode::mergeRefused, [&] { remaining(state, range, "x.part"); }),
                HasSubstr("x.part holds photons 10..20"))
        << range.begin;
  state.header.photons.add({30, 40});
  errorOf(ExitCode::mergeRefused, [&] { remaining(state, {10, 50}, "x.part"); });
  errorOf(ExitCode::mergeRefused, [&] { runJob(job({10, 50}, 1), state, nullptr); });
}

TEST_F(BakeJobs, ProbeRaysTellScenesApart) {
  const Hash128 here = probeRays(photonScene_);
  EXPECT_EQ(here, probeRays(PhotonScene(roomWith(0.4671f))));
  EXPECT_NE(here, probeRays(PhotonScene(roomWith(0.4672f))));
}

}  // namespace
}  // namespace lucarne::bake_job_test
