// Memory and disks that are too small: refused before the work where that can be known, and no photon lost where not.
#include "tests/cli/program.h"

namespace lucarne::resources_test {
namespace {

using test::Background;

class Resources : public test::ProgramTest {
 protected:
  static std::string bakeOf(const std::string& options) {
    const bool given = options.find("--density") != std::string::npos;
    return std::string("\"$LUCARNE\" bake") + test::kQuickScene + (given ? "" : "--density 10 ") + options;
  }
  std::string log() const { return test::slurp(folder_ / "log"); }
};

TEST_F(Resources, MemoryThatIsTooLittleIsRefusedAndWhatIsToldToFitFits) {
  const auto expected = [&](const std::string& options) {
    const auto o = shell(bakeOf("-o a.dlm --photons 1k --threads 1 --texels 100M " + options));
    EXPECT_EQ(o.code, 0) << o.err;
    const std::size_t at = o.err.find("memory: ");
    EXPECT_NE(at, std::string::npos) << o.err;
    return at == std::string::npos ? 0 : std::stod(o.err.substr(at + 8));
  };
  // MiB, about half way between the scene alone and the whole bake.
  const double small = expected("--density 1"), large = expected("--density 150");
  ASSERT_GT(large, small + 4);
  const int allowed = static_cast<int>((small + large) / 2);
  const std::string limited =
      "-o b.dlm --photons 1k --threads 1 --texels 100M --report b.json --memory " + std::to_string(allowed) + "M ";
  const auto refused = shell(bakeOf(limited + "--density 150"));
  ASSERT_EQ(refused.code, 5) << refused.err;
  EXPECT_NE(refused.err.find(std::to_string(allowed) + " MiB are allowed (--memory)"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(exists("b.dlm"));
  const std::size_t at = refused.err.find("--density ");
  ASSERT_NE(at, std::string::npos) << refused.err;
  const std::string density = refused.err.substr(at, refused.err.find(' ', at + 10) - at);
  const auto fits = shell(bakeOf(limited + density));
  EXPECT_EQ(fits.code, 0) << density << "\n" << fits.err;
  if (test::isSanitized()) return;
  const auto report = nlohmann::json::parse(test::slurp(folder_ / "b.json"));
  EXPECT_LE(report["peak_memory_bytes"].get<double>(), 1.1 * allowed * 1024 * 1024);
}

class FullDisk : public Resources {
 protected:
  void SetUp() override {
    Resources::SetUp();
    if (shell("unshare -m true").code != 0) GTEST_SKIP() << "no disk of our own can be mounted here (unshare -m)";
  }
  /// A command in a folder `disk` of so many kilobytes, seen by it alone.
  static std::string onDisk(int kilobytes, const std::string& command) {
    return "unshare -m sh -c 'mkdir -p disk && mount -t tmpfs -o size=" + std::to_string(kilobytes) +
           "k none disk && " + command + "'";
  }
  static std::string inShell(std::string command) {  // kQuickScene has quotes
    std::string quoted;
    for (const char c : command) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted;
  }
  static std::string bakeOn(int kilobytes, const std::string& before, const std::string& options,
                            const std::string& after = "") {
    return onDisk(kilobytes, inShell(before + bakeOf("-o disk/room.dlm " + options) + after));
  }
};

TEST_F(FullDisk, TooLittleRoomIsToldBeforeTheWork) {
  const auto o = shell(bakeOn(64, "", "--photons 20k"));
  EXPECT_EQ(o.code, 5) << o.err;
  EXPECT_NE(o.err.find("light maps and two saved states need"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("64 KiB are free"), std::string::npos) << o.err;
}

TEST_F(FullDisk, FilledMeanwhileTheBakeGoesOnAndSavesAgainWhenThereIsRoom) {
  // Full from before the first state until one could not be saved.
  const auto o = shell(bakeOn(8000,
                              "(while ! ls disk/room.checkpoint/lock >/dev/null 2>&1; do sleep 0.01; done; "
                              "dd if=/dev/zero of=disk/hog bs=4k >/dev/null 2>&1; touch full; "
                              "until [ -e over ] || grep -q \"no state saved\" log; do sleep 0.01; done; "
                              "rm disk/hog) & ",
                              "--time 4s --checkpoint 0.5s --report report.json 2>log",
                              "; code=$?; touch over; cat log >&2; wait; "
                              "\"$LUCARNE\" info disk/room.dlm --json > info.json; exit $code"));
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(exists("full"));
  EXPECT_NE(o.err.find("no state saved"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("states are saved again"), std::string::npos) << o.err;
  const auto info = nlohmann::json::parse(test::slurp(folder_ / "info.json")),
             report = nlohmann::json::parse(test::slurp(folder_ / "report.json"));
  EXPECT_EQ(info["content_hash"], report["content_hash"]);
  const std::string photons = std::to_string(report["photons"].get<std::uint64_t>());
  ASSERT_EQ(shell(bakeOf("-o whole.dlm --quiet --photons " + photons)).code, 0);
  EXPECT_EQ(contentHash("whole.dlm"), report["content_hash"].get<std::string>());
}

TEST_F(FullDisk, StillFullAtTheEndTheStateIsKeptElsewhereAndGoesOn) {
  const auto o = shell(bakeOn(30000,
                              "(while ! ls disk/room.checkpoint/lock >/dev/null 2>&1; do sleep 0.01; done; "
                              "dd if=/dev/zero of=disk/hog bs=4k >/dev/null 2>&1) & ",
                              "--photons 400k --checkpoint 10h 2>log", "; code=$?; cat log >&2; wait; exit $code"));
  EXPECT_EQ(o.code, 5) << o.err;
  EXPECT_NE(o.err.find("No space left on device"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("400k photons are saved as"), std::string::npos) << o.err;
  ASSERT_TRUE(exists("room.rescued.part")) << o.err;
  std::filesystem::rename(folder_ / "room.rescued.part", folder_ / "room.part");
  const auto resumed = shell(bakeOf("-o room.dlm --photons 400k --resume"));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("going on from 400k photons"), std::string::npos) << resumed.err;
  ASSERT_EQ(shell(bakeOf("-o whole.dlm --quiet --photons 400k")).code, 0);
  EXPECT_EQ(contentHash("whole.dlm"), contentHash("room.dlm"));
}

TEST_F(Resources, AFolderOfStatesThatVanishesIsMadeAgain) {
  {
    Background bake(folder_, bakeOf("-o room.dlm --photons 100G --checkpoint 0.05s"));
    while (bake.running() && !exists("room.checkpoint/lock")) ::usleep(1000);
    std::filesystem::remove_all(folder_ / "room.checkpoint");
    ::usleep(200'000);
    ::kill(bake.pid(), SIGINT);
    EXPECT_EQ(bake.exitCode(), 130) << log();
  }
  EXPECT_NE(log().find("photons are saved in room.checkpoint"), std::string::npos) << log();
  EXPECT_EQ(shell(bakeOf("-o room.dlm --quiet --time 1s --resume")).code, 0);
}

}  // namespace
}  // namespace lucarne::resources_test
