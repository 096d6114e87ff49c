// Signals: a bake that is asked to stop saves its state and says how to go on, and its result is that of one which
// nobody disturbed.
#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/program.h"

namespace lucarne::interrupt_test {
namespace {

namespace fs = std::filesystem;
using test::Background;

class Interrupt : public test::ProgramTest {
 protected:
  static std::string bakeOf(const std::string& options) {
    return std::string("\"$LUCARNE\" bake") + test::kQuickScene + "-o room.dlm --density 10 " + options;
  }
  std::string log() const { return test::slurp(folder_ / "log"); }

  /// Waits until the log holds these words; false when the command ends before.
  bool waitForWords(Background& command, const std::string& words) const {
    while (log().find(words) == std::string::npos) {
      if (!command.running()) return false;
      ::usleep(1000);
    }
    return true;
  }
  /// Until the bake traces: its folder of states is made just before.
  bool waitForStart(Background& command, const std::string& name = "room.checkpoint/lock") const {
    while (!exists(name)) {
      if (!command.running()) return false;
      ::usleep(1000);
    }
    return true;
  }
  std::uint64_t savedPhotons() const {
    std::uint64_t most = 0;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint", none)) {
      if (entry.path().extension() != ".part") continue;
      const auto o = run("info '" + entry.path().string() + "' --json");
      EXPECT_EQ(o.code, 0) << "a state that is there is whole: " << o.err;
      if (o.code == 0) most = std::max(most, nlohmann::json::parse(o.out)["photons"].get<std::uint64_t>());
    }
    return most;
  }
  /// The interrupted bake taken up and brought to an end, against one in one go.
  void expectUndisturbed(std::uint64_t photons) {
    const std::string count = " --quiet --photons " + std::to_string(photons);
    ASSERT_EQ(shell(bakeOf("--resume" + count)).code, 0) << log();
    mustRun(std::string("bake") + test::kQuickScene + "-o whole.dlm --density 10 --threads 1" + count);
    EXPECT_EQ(contentHash("room.dlm"), contentHash("whole.dlm"));
    EXPECT_TRUE(same("room.dlm", "whole.dlm"));
    EXPECT_FALSE(exists("room.checkpoint"));
  }
  static void sleepFor(double milliseconds) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds));
  }
};

struct Asked {
  int signal;
  const char* name;
};
class InterruptBy : public Interrupt, public testing::WithParamInterface<Asked> {};

TEST_P(InterruptBy, SavesTheStateSaysHowToGoOnAndLosesNothing) {
  {
    Background bake(folder_, bakeOf("--photons 100G --threads 2"));
    ASSERT_TRUE(waitForStart(bake)) << log();
    sleepFor(300);
    ::kill(bake.pid(), GetParam().signal);
    EXPECT_EQ(bake.exitCode(), 130) << log();
  }
  EXPECT_NE(log().find("photons are saved in room.checkpoint: go on with the same command and --resume"),
            std::string::npos)
      << log();
  EXPECT_FALSE(exists("room.dlm"));
  const std::uint64_t saved = savedPhotons();
  ASSERT_GT(saved, 0u);
  expectUndisturbed(saved + 50'000);
}
INSTANTIATE_TEST_SUITE_P(Signals, InterruptBy,
                         testing::Values(Asked{SIGINT, "INT"}, Asked{SIGTERM, "TERM"}, Asked{SIGHUP, "HUP"}),
                         [](const auto& asked) { return asked.param.name; });

TEST_F(Interrupt, AgainAndAgainAtRandomMomentsGivesTheSameBits) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> moment(0, 120);
  std::uint64_t before = 0;
  for (int round = 0; round < 6; ++round) {
    fs::remove(folder_ / "room.checkpoint" / "lock");  // it tells that the next one has begun
    Background bake(folder_, bakeOf("--photons 100G --resume --quiet --threads " + std::to_string(1 + round % 3)));
    ASSERT_TRUE(waitForStart(bake)) << log();
    sleepFor(moment(random));
    ::kill(bake.pid(), round % 2 == 0 ? SIGINT : SIGTERM);
    ASSERT_EQ(bake.exitCode(), 130) << log();
    const std::uint64_t now = savedPhotons();
    EXPECT_GE(now, before);
    before = now;
  }
  ASSERT_GT(before, 0u);
  expectUndisturbed(before + 50'000);
}

TEST_F(Interrupt, ASecondSignalStopsAtOnceAndTheLastStateIsWhole) {
  std::uint64_t saved = 0;
  {
    Background bake(folder_, bakeOf("--photons 100G --checkpoint 0.05s"));
    while (bake.running() && saved == 0) saved = savedPhotons();
    ASSERT_TRUE(bake.running());
    ::kill(bake.pid(), SIGINT);
    sleepFor(60);
    ::kill(bake.pid(), SIGINT);  // lands before the end or after it
    const int code = bake.exitCode();
    EXPECT_TRUE(code == 130 || code == -1) << "once all is saved a signal just ends the program: " << code << log();
  }
  EXPECT_GE(savedPhotons(), saved);
  expectUndisturbed(savedPhotons() + 50'000);
}

TEST_F(Interrupt, BeforeTheFirstPhotonLeavesNothing) {
  Background bake(folder_, bakeOf("--photons 100G"));
  sleepFor(1);
  ::kill(bake.pid(), SIGINT);
  const int code = bake.exitCode();
  EXPECT_TRUE(code == 130 || code == -1) << "before the program takes signals they end it: " << code << log();
  EXPECT_FALSE(exists("room.dlm"));
}

TEST_F(Interrupt, WithoutCheckpointsItSaysThatNothingIsSaved) {
  Background bake(folder_, bakeOf("--photons 100G --checkpoint 0 --direct gathered --direct-samples 1"));
  ASSERT_TRUE(waitForWords(bake, "gathering direct light")) << log();
  ::kill(bake.pid(), SIGTERM);
  EXPECT_EQ(bake.exitCode(), 130) << log();
  EXPECT_NE(log().find("nothing is saved, since --checkpoint is 0"), std::string::npos) << log();
  EXPECT_FALSE(exists("room.checkpoint"));
}

TEST_F(Interrupt, WhileDirectLightIsGatheredItGoesOnToTheSameBits) {
  {
    Background bake(folder_, bakeOf("--direct gathered --direct-samples 4000 --photons 50k"));
    ASSERT_TRUE(waitForWords(bake, "gathering direct light")) << log();
    ::kill(bake.pid(), SIGINT);
    ASSERT_EQ(bake.exitCode(), 130) << log();
  }
  ASSERT_EQ(shell(bakeOf("--resume --direct gathered --direct-samples 4000 --photons 50k --quiet")).code, 0);
  mustRun(std::string("bake") + test::kQuickScene +
          "-o whole.dlm --density 10 --direct gathered --direct-samples 4000 --photons 50k --quiet");
  EXPECT_TRUE(same("room.dlm", "whole.dlm"));
}

TEST_F(Interrupt, APreviewIsPlayableAndChangesNothing) {
  std::uint64_t saved = 0;
  {
    Background bake(folder_, bakeOf("--photons 100G"));
    ASSERT_TRUE(waitForStart(bake)) << log();
    for (int round = 0; round < 2; ++round) {
      fs::remove_all(folder_ / "room.preview.dlm");
      sleepFor(100);
      ::kill(bake.pid(), SIGUSR1);
      while (bake.running() && !exists("room.preview.dlm/manifest.json")) ::usleep(1000);
      ASSERT_TRUE(bake.running()) << log();
      const auto o = run("info room.preview.dlm --json");
      ASSERT_EQ(o.code, 0) << o.err;
      const std::uint64_t photons = nlohmann::json::parse(o.out)["photons"].get<std::uint64_t>();
      EXPECT_GT(photons, saved) << "a later one has more";
      saved = photons;
    }
    ::kill(bake.pid(), SIGINT);
    EXPECT_EQ(bake.exitCode(), 130) << log();
  }
  const std::uint64_t traced = savedPhotons();
  ASSERT_GE(traced, saved);
  expectUndisturbed(traced + 50'000);
  // The preview is the bake of so many photons.
  mustRun(std::string("bake") + test::kQuickScene + "-o early.dlm --density 10 --quiet --photons " +
          std::to_string(saved));
  EXPECT_EQ(contentHash("room.preview.dlm"), contentHash("early.dlm"));
  EXPECT_TRUE(same("room.preview.dlm/directional.exr", "early.dlm/directional.exr"));
}

}  // namespace
}  // namespace lucarne::interrupt_test
