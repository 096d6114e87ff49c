// kill -9 at any moment, resume, and the result is that of a bake which nobody disturbed.
#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/program.h"

namespace lucarne::kill_test {
namespace {

namespace fs = std::filesystem;
using test::Background;

class Kill : public test::ProgramTest {
 protected:
  static std::string bakeOf(const std::string& photons) {
    return std::string("\"$LUCARNE\" bake") + test::kQuickScene +
           "-o room.dlm --density 10 --checkpoint 0.05s --threads 1 --resume --quiet --photons " + photons;
  }

  /// True while a file is being written aside whose name begins so.
  bool writing(const fs::path& folder, const std::string& prefix) const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().filename().string().starts_with(prefix)) return true;
    return false;
  }

  /// Waits until `done()` or the command ends.
  template <class Done>
  static bool waitFor(Background& command, Done&& done) {
    while (command.running()) {
      if (done()) return true;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return false;
  }

  static void sleepFor(double milliseconds) {
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds));
  }

  std::uint64_t savedPhotonsOf(const fs::path& state) const {
    const auto o = run("info '" + state.string() + "' --json");
    EXPECT_EQ(o.code, 0) << "a state that is there is whole: " << o.err;
    return o.code == 0 ? nlohmann::json::parse(o.out)["photons"].get<std::uint64_t>() : 0;
  }

  std::uint64_t savedPhotons() const {
    std::uint64_t most = 0;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint", none)) {
      if (entry.path().extension() == ".part") most = std::max(most, savedPhotonsOf(entry.path()));
    }
    return most;
  }

  bool hasState() const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint", none))
      if (entry.path().extension() == ".part") return true;
    return false;
  }

  /// Of a bake, which is then killed.
  double millisecondsToFirstState() {
    const auto start = std::chrono::steady_clock::now();
    Background bake(folder_, bakeOf("1G"));
    EXPECT_TRUE(waitFor(bake, [&] { return hasState(); }));
    bake.kill();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

  void expectUndisturbed(const std::string& photons) {
    mustRun(std::string("bake") + test::kQuickScene + "-o whole.dlm --density 10 --threads 2 --quiet --photons " +
            photons);
    EXPECT_EQ(contentHash("room.dlm"), contentHash("whole.dlm"));
    EXPECT_TRUE(same("room.dlm", "whole.dlm"));
    EXPECT_FALSE(exists("room.checkpoint"));
    EXPECT_FALSE(writing(folder_, ".room.dlm.lucarne-")) << "leftovers of killed writers stay";
  }
};

TEST_F(Kill, ThirtyTimesAtRandomMomentsAndInTheMiddleOfWriting) {
  std::mt19937 random(7);
  // Moments before and after the first state is saved, however fast program and machine are.
  std::uniform_real_distribution<double> soon(0, std::max(250.0, 2 * millisecondsToFirstState())), inWriting(0, 6);
  int killed = 0, whileWriting = 0;
  std::uint64_t before = savedPhotons();
  for (int round = 0; killed < 30 && round < 200; ++round) {
    Background bake(folder_, bakeOf("1G"));
    if (round % 2 == 0) {
      sleepFor(soon(random));
    } else if (waitFor(bake, [&] { return writing(folder_ / "room.checkpoint", ".state-"); })) {
      sleepFor(round % 4 == 1 ? 0 : inWriting(random));
      whileWriting += writing(folder_ / "room.checkpoint", ".state-");
    }
    if (bake.running()) ++killed;
    bake.kill();
    const std::uint64_t now = savedPhotons();
    EXPECT_GE(now, before) << "no photon that was saved is lost";
    before = now;
  }
  EXPECT_EQ(killed, 30) << test::slurp(folder_ / "log");
  EXPECT_GT(whileWriting, 0);
  ASSERT_GT(before, 0u);
  const std::string enough = std::to_string(before + 50'000);
  ASSERT_EQ(Background(folder_, bakeOf(enough)).exitCode(), 0) << test::slurp(folder_ / "log");
  expectUndisturbed(enough);
}

TEST_F(Kill, WhileTheLightMapsAreWritten) {
  int killed = 0;
  for (int round = 0; round < 3; ++round) {
    Background bake(folder_, bakeOf("60k"));
    if (waitFor(bake, [&] { return writing(folder_, ".room.dlm.lucarne-"); })) {
      bake.kill();
      ++killed;
    }
  }
  EXPECT_GT(killed, 0);
  ASSERT_EQ(Background(folder_, bakeOf("60k")).exitCode(), 0) << test::slurp(folder_ / "log");
  expectUndisturbed("60k");
}

TEST_F(Kill, ADamagedNewestStateFallsBackWithAMessage) {
  {
    Background bake(folder_, bakeOf("1G"));
    const auto twoStates = [&] {
      std::error_code none;
      int states = 0;
      for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint", none))
        states += entry.path().extension() == ".part";
      return states >= 2;
    };
    ASSERT_TRUE(waitFor(bake, twoStates));
  }
  std::vector<fs::path> states;
  for (const auto& entry : fs::directory_iterator(folder_ / "room.checkpoint"))
    if (entry.path().extension() == ".part") states.push_back(entry.path());
  std::sort(states.begin(), states.end());
  fs::resize_file(states.back(), fs::file_size(states.back()) - 1000);
  const std::string enough = std::to_string(savedPhotonsOf(states.front()) + 100'000);
  const auto o = run(std::string("bake") + test::kQuickScene + "-o room.dlm --density 10 --resume --photons " + enough);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find(states.back().filename().string() + " is cut short"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("going on from"), std::string::npos) << o.err;
  expectUndisturbed(enough);
}

}  // namespace
}  // namespace lucarne::kill_test
