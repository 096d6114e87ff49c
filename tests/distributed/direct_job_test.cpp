// Samples of direct light are shared out, saved, merged and taken up again as photons are, to the same bits.
#include <gmock/gmock.h>

#include "app/bake_command.h"
#include "app/bake_identity.h"
#include "app/bake_scene.h"
#include "distributed/bake_job.h"
#include "distributed/merge.h"
#include "tests/base/temp_folder.h"
#include "tests/distributed/part_fixture.h"
#include "tests/support/scene_builder.h"

namespace lucarne::direct_job_test {
namespace {

using ::testing::HasSubstr;

Scene smallRoom() {
  test::SceneBuilder s;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.5f, 0.6f, 0.4f}), true);
  s.addBox({1, 0.2, 1}, {2, 1, 2.5}, s.addDiffuse({0.7f, 0.2f, 0.2f}), false);
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

class DirectJobs : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr std::uint64_t kPhotons = 40'000, kSamples = 20;

  DirectJobs()
      : scene_(smallRoom()),
        photonScene_(scene_),
        plan_(makePlan(scene_, options())),
        map_(scene_, plan_.charts, plan_.layout, plan_.tallies),
        gather_({photonScene_, plan_.charts, plan_.layout, plan_.tallies, plan_.directions}, {5}),
        bytes_(test::madeUpScene(1000)) {}

  static BakeOptions options() {
    BakeOptions o;
    o.photons = kPhotons;
    o.texelsPerMetre = 3;
    o.keepAllDirections = true;
    o.seed = 5;
    o.direct = DirectMode::gathered;
    o.directSamples = kSamples;
    o.moments = GetParam();
    return o;
  }
  BakeJob job(IndexRange photons, IndexRange samples, int threads) const {
    PhotonRunOptions run = runOptions(options());
    run.threads = threads;
    return {.task = {photonScene_, map_, plan_.tallies, plan_.directions},
            .run = run,
            .range = photons,
            .scene = bytes_,
            .checkpointSeconds = 0,
            .progress = [](const RunProgress&) {},
            .direct = DirectJob{gather_, samples}};
  }
  BakeState nothingYet() const {
    PartHeader header = test::madeUpHeader({}, bytes_);
    header.ledger = {};
    header.planned.samples = kSamples;
    header.direct.emplace();
    return {std::move(header), Tallies(plan_.tallies, Tallies::Sets::photonsAndDirect)};
  }
  BakeState bake(IndexRange photons, IndexRange samples, int threads) const {
    BakeState state = nothingYet();
    runJob(job(photons, samples, threads), state, nullptr);
    return state;
  }
  BakeState bakeWhole(int threads) const { return bake({0, kPhotons}, {0, kSamples}, threads); }
  static void expectSame(const BakeState& a, const BakeState& b) {
    EXPECT_EQ(a.tallies.contentHash(), b.tallies.contentHash());
    EXPECT_EQ(a.header.direct->counts, b.header.direct->counts);
    EXPECT_EQ(toText(a.header.direct->samples), toText(b.header.direct->samples));
    EXPECT_EQ(toText(a.header.photons), toText(b.header.photons));
  }
  static void write(const BakeState& state, std::span<const std::uint8_t> scene, const std::filesystem::path& path) {
    writePart(path, state.header, scene, state.tallies);
  }

  Scene scene_;
  PhotonScene photonScene_;
  BakePlan plan_;
  TexelMap map_;
  DirectGather gather_;
  std::vector<std::uint8_t> bytes_;
};

INSTANTIATE_TEST_SUITE_P(Moments, DirectJobs, ::testing::Bool(),
                         [](const auto& with) { return with.param ? "With" : "Without"; });

TEST_P(DirectJobs, AnyNumberOfThreadsGivesTheSameBits) {
  const BakeState one = bakeWhole(1);
  EXPECT_GT(one.header.direct->counts.places, 1000u);
  for (const int threads : {2, 3}) expectSame(bakeWhole(threads), one);
}

TEST_P(DirectJobs, PartsMergedInAnyOrderAreOneBake) {
  const BakeState whole = bakeWhole(2);
  const TempFolder temp;
  std::vector<std::filesystem::path> files;
  constexpr std::uint64_t kParts = 30;  // more than samples: some parts have none
  for (std::uint64_t k = 1; k <= kParts; ++k) {
    BakeOptions o = options();
    o.part = PartNumber{k, kParts};
    files.push_back(temp / (std::to_string(k) + ".part"));
    write(bake(photonsOf(o), samplesOf(o), 1 + static_cast<int>(k % 3)), bytes_, files.back());
  }
  for (const std::size_t step : {1u, 7u, 29u}) {
    std::vector<std::filesystem::path> order;
    for (std::size_t i = 0; i < kParts; ++i) order.push_back(files[i * step % kParts]);
    const PartSet parts = joinParts(order);
    BakeState sum{parts.whole, parts.whole.makeTallies()};
    EXPECT_EQ(sumParts(parts, sum.tallies, [](std::uint64_t) {}), bytes_);
    expectSame(sum, whole);
  }
}

TEST_P(DirectJobs, EverySavedStateGoesOnToTheSameEnd) {
  const BakeState whole = bakeWhole(2);
  const TempFolder temp;
  CheckpointFolder folder(temp / "x.checkpoint");
  folder.open();
  BakeState state = nothingYet();
  int states = 0;
  for (const IndexRange& end : {IndexRange{0, 1}, IndexRange{1, 7}, IndexRange{3, kSamples}}) {
    BakeJob saving = job({0, end.begin * 5'000}, {0, end.end}, 2);
    saving.checkpointSeconds = 1e-6;
    EXPECT_TRUE(runJob(saving, state, &folder).saved);
    BakeState resumed = nothingYet();
    const auto header = folder.load(resumed.tallies, [](const PartHeader&, const std::string&) {});
    ASSERT_TRUE(header);
    resumed.header = *header;
    runJob(job({0, kPhotons}, {0, kSamples}, 1 + states++), resumed, nullptr);
    expectSame(resumed, whole);
  }
}

TEST_P(DirectJobs, SamplesThatAreNoBeginningAreRefused) {
  BakeState state = bake({0, 0}, {3, 5}, 1);
  EXPECT_THROW(remainingSamples(state, {0, kSamples}, "x"), Error);
  EXPECT_THROW(remainingSamples(state, {3, 4}, "x"), Error);
  EXPECT_EQ(remainingSamples(state, {3, 9}, "x").begin, 5u);
}

TEST_P(DirectJobs, SamplesThatTwoPartsHoldAreRefused) {
  const TempFolder temp;
  write(bake({0, 1000}, {0, 6}, 1), bytes_, temp / "a.part");
  write(bake({1000, 2000}, {5, 9}, 1), bytes_, temp / "b.part");
  write(bake({1000, 2000}, {6, 9}, 1), bytes_, temp / "c.part");
  EXPECT_NO_THROW(joinParts({temp / "a.part", temp / "c.part"}));
  try {
    joinParts({temp / "a.part", temp / "b.part"});
    FAIL() << "merged";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::mergeRefused);
    EXPECT_THAT(error.what(), HasSubstr("both hold samples of direct light 5..6"));
  }
}

/// A header of made-up gathered light, spoiled.
class DirectHeaders : public DirectJobs {
 protected:
  std::string refusal(const std::function<void(nlohmann::json&)>& change) const {
    BakeState state = bake({0, 100}, {0, 2}, 1);
    state.header.lightEntries = 10;
    state.header.momentEntries = GetParam() ? 10 : 0;
    nlohmann::json json = toJson(state.header);
    change(json);
    try {
      partHeaderFrom(JsonView(json, "x"));
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Moments, DirectHeaders, ::testing::Bool(),
                         [](const auto& with) { return with.param ? "With" : "Without"; });

TEST_P(DirectHeaders, AreReadStrictly) {
  EXPECT_EQ(refusal([](nlohmann::json&) {}), "");
  const auto set = [](nlohmann::json& j) -> nlohmann::json& { return j["tally_sets"][1]; };
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["name"] = "third"; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { j["tally_sets"].push_back(set(j)); }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["normaliser"] = 3; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["moment_entries"] = 3; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { j["tally_sets"][0]["moment_entries"] = -1; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["texels"] = 3; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["more"] = 3; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["counts"].erase("clamped"); }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { set(j)["ranges"] = {{0, 1u << 21}}; }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { j["planned"].erase("samples"); }), "");
  EXPECT_NE(refusal([&](nlohmann::json& j) { j["tally_sets"].erase(1); }), "") << "planned.samples is left over";
}

TEST_P(DirectJobs, AnAlteredSecondSetIsRefused) {
  const TempFolder temp;
  const BakeState state = bake({0, 100}, {0, 2}, 1);
  write(state, bytes_, temp / "a.part");
  const std::string bytes = test::bytesOf(temp / "a.part");
  ASSERT_EQ(test::refusalOf(temp / "a.part"), "");
  const ExrRows rows = partRows(PartReader(temp / "a.part").header(), "");
  ASSERT_EQ(rows.layers().size(), GetParam() ? 7u : 5u);
  std::string spoiled = bytes;
  const std::size_t last = bytes.size() - kSealBytes - rows.rowBytes(rows.layers().size() - 1);  // statistics or moments of direct light
  spoiled[last] = static_cast<char>(spoiled[last] ^ 1);
  test::setBytes(temp / "b.part", test::resealed(spoiled));
  EXPECT_NE(test::refusalOf(temp / "b.part"), "");
  Tallies photonsAlone(plan_.tallies);
  EXPECT_THROW(addPart(PartReader(temp / "a.part"), photonsAlone), PartError);
}

TEST_P(DirectJobs, SharesOfPartsHoldEverySampleOnce) {
  BakeOptions o = options();
  for (const std::uint64_t parts : {1u, 3u, 20u, 77u}) {
    std::uint64_t at = 0;
    for (std::uint64_t k = 1; k <= parts; ++k) {
      o.part = PartNumber{k, parts};
      EXPECT_EQ(samplesOf(o).begin, at);
      at = samplesOf(o).end;
    }
    EXPECT_EQ(at, kSamples);
  }
}

TEST_P(DirectJobs, SettingsTellTheTwoWaysApart) {
  BakeOptions photons = options();
  photons.direct = DirectMode::photons;
  EXPECT_FALSE(traceSettings(photons).contains("direct"));
  EXPECT_EQ(traceSettings(options())["direct"], "gathered");
  PartHeader header;
  header.identity.settings = traceSettings(options());
  header.identity.resolve = resolveSettings(options());
  header.sceneName = "room.glb";
  header.planned = {kPhotons, 0, kSamples};
  EXPECT_EQ(optionsOf(header, "x").direct, DirectMode::gathered);
  EXPECT_THAT(bakeCommand(header, "a.part", ""), HasSubstr("--direct gathered --direct-samples 20"));
}

}  // namespace
}  // namespace lucarne::direct_job_test
