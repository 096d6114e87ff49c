// --resume: what it goes on with, and what it refuses.
#include "tests/cli/program.h"

namespace lucarne::resume_test {
namespace {

namespace fs = std::filesystem;
using test::kQuickScene;

class Resume : public test::ProgramTest {
 protected:
  /// A bake that was killed after its first state.
  void leaveState(const std::string& options) {
    test::Background bake(folder_, std::string("\"$LUCARNE\" bake") + kQuickScene +
                                       "-o room.dlm --density 10 --checkpoint 0.05s --quiet " + options);
    while (bake.running() && states() == 0) ::usleep(1000);
    bake.kill();
    ASSERT_GT(states(), 0);
  }
  std::string newestState() const {
    std::string newest;
    for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint"))
      if (entry.path().extension() == ".part") newest = std::max(newest, entry.path().filename().string());
    return newest;
  }
  int states() const {
    int count = 0;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint", none))
      count += entry.path().extension() == ".part";
    return count;
  }
  void expectRefused(const std::string& options, int code, const std::string& words) {
    const int before = states();
    const auto o = run("bake -o room.dlm --quiet --resume " + options);
    EXPECT_EQ(o.code, code) << options << "\n" << o.err;
    EXPECT_NE(o.err.find(words), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    EXPECT_EQ(states(), before) << "the state stays";
  }
};

TEST_F(Resume, OfAnotherBakeIsRefusedWithTheFieldNamed) {
  leaveState("--photons 1G");
  const std::string scene = std::string(kQuickScene) + "--density 10 ";
  expectRefused(scene + "--photons 1G --seed 5", 4, "seed: 5 and 0");
  expectRefused(scene + "--photons 1G --directions 20", 4, "directions: 20 and 14");
  expectRefused(scene + "--photons 1G --light direct", 4, "light: ");
  expectRefused(std::string(kQuickScene) + "--photons 1G --density 5", 4, "texels_per_metre: 5.0 and 10.0");
  expectRefused(scene + "--photons 1G --isa sse4.2", 4, "ray_caster: ");
  expectRefused("--keep-all-directions --density 10 --photons 1G", 4, "differ in the scene (");
  expectRefused(scene + "--photons 10", 4, "photons 0..");
}

TEST_F(Resume, WithAnotherKernelOrFormatGoesOn) {
  leaveState("--photons 1G");
  const auto state = nlohmann::json::parse(run("info room.checkpoint/" + newestState() + " --json").out);
  const std::string photons = std::to_string(state["photons"].get<std::uint64_t>() + 50'000);
  mustRun(std::string("bake") + kQuickScene +
          "-o whole.dlm --density 10 --kernel box --format float --quiet --photons " + photons);
  mustRun(std::string("bake") + kQuickScene +
          "-o room.dlm --density 10 --kernel box --format float --resume --quiet --photons " + photons);
  EXPECT_TRUE(same("room.dlm", "whole.dlm"));
}

TEST_F(Resume, WithoutItAnInterruptedBakeIsMovedAside) {
  leaveState("--photons 1G");
  const auto o = run(std::string("bake") + kQuickScene + "-o room.dlm --density 10 --photons 20k");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("moved to room.checkpoint.old"), std::string::npos) << o.err;
  EXPECT_TRUE(exists("room.checkpoint.old"));
  EXPECT_FALSE(exists("room.checkpoint"));
}

TEST_F(Resume, WithoutAStateStartsAnew) {
  const auto o = run(std::string("bake") + kQuickScene + "-o room.dlm --density 10 --photons 20k --resume");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("starting anew"), std::string::npos) << o.err;
}

TEST_F(Resume, OfAFinishedBakeRewritesTheReportAlone) {
  mustRun(std::string("bake") + kQuickScene + "-o room.dlm --density 10 --photons 200k --report a.json --quiet");
  const auto written = fs::last_write_time(folder_ / "room.dlm" / "manifest.json");
  mustRun(std::string("bake") + kQuickScene +
          "-o room.dlm --density 10 --photons 200k --report b.json --resume --quiet");
  EXPECT_EQ(fs::last_write_time(folder_ / "room.dlm" / "manifest.json"), written);
  mustRun(std::string("bake") + kQuickScene +
          "-o room.dlm --density 10 --photons 200k --report a.json --resume --quiet");
  const auto a = nlohmann::json::parse(test::slurp(folder_ / "a.json")),
             b = nlohmann::json::parse(test::slurp(folder_ / "b.json"));
  EXPECT_EQ(a["content_hash"], b["content_hash"]);
  EXPECT_GT(a["seconds"].get<double>(), 0) << "times of the run that traced, where its report is still there";
  for (const auto& [key, value] : a.items()) EXPECT_TRUE(b.contains(key)) << key;
}

TEST_F(Resume, WithMorePhotonsGoesOnFromAFinishedPart) {
  mustRun(std::string("bake") + kQuickScene + "-o room.dlm --density 10 --photons 100k --keep-part --quiet");
  ASSERT_TRUE(exists("room.part"));
  const auto o =
      run(std::string("bake") + kQuickScene + "-o room.dlm --density 10 --photons 250k --resume --keep-part");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("going on from 100k photons"), std::string::npos) << o.err;
  mustRun(std::string("bake") + kQuickScene + "-o whole.dlm --density 10 --photons 250k --quiet");
  EXPECT_TRUE(same("room.dlm", "whole.dlm"));
}

TEST_F(Resume, OfAPartTracesNothingTwice) {
  mustRun(std::string("bake") + kQuickScene + "-o room.part --density 10 --photons 200k --part 2/4 --quiet");
  const std::string hash = contentHash("room.part");
  const auto o =
      run(std::string("bake") + kQuickScene + "-o room.part --density 10 --photons 200k --part 2/4 --resume");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("going on from 50k photons"), std::string::npos) << o.err;
  EXPECT_EQ(contentHash("room.part"), hash);
}

TEST_F(Resume, APartIsNotReplacedByOtherPhotons) {
  mustRun(std::string("bake") + kQuickScene + "-o room.part --density 10 --photons 200k --part 2/4 --quiet");
  const std::string hash = contentHash("room.part");
  const auto o = run(std::string("bake") + kQuickScene + "-o room.part --density 10 --photons 200k --part 3/4 --quiet");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("it holds other photons (50k..100k)"), std::string::npos) << o.err;
  EXPECT_EQ(contentHash("room.part"), hash);
}

TEST_F(Resume, TwoBakesOfOneOutputAreNotMixed) {
  test::Background bake(folder_, std::string("\"$LUCARNE\" bake") + kQuickScene +
                                     "-o room.dlm --density 10 --checkpoint 0.05s --quiet --photons 1G");
  while (bake.running() && states() == 0) ::usleep(1000);
  const auto o = run(std::string("bake") + kQuickScene + "-o room.dlm --density 10 --photons 1k --quiet");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("another bake is writing to room.checkpoint"), std::string::npos) << o.err;
}

}  // namespace
}  // namespace lucarne::resume_test
