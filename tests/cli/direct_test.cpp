// Gathered direct light in the program: whole, in parts, killed, over MPI.
#include <chrono>
#include <thread>

#include "tests/cli/program.h"

namespace lucarne::direct_test {
namespace {

class Gathered : public test::ProgramTest {
 protected:
  static std::string options(const std::string& output,
                             const std::string& size = "--direct-samples 12 --photons 200k") {
    return std::string(test::kQuickScene) + "--density 10 --quiet --direct gathered " + size + " -o " + output + " ";
  }
};

TEST_F(Gathered, PartsMergeToTheWhole) {
  mustRun("bake" + options("whole.dlm") + "--threads 2 --report whole.json");
  const auto report = nlohmann::json::parse(test::slurp(folder_ / "whole.json"));
  EXPECT_EQ(report["direct"]["mode"], "gathered");
  EXPECT_EQ(report["direct"]["samples"], 12);
  for (int k = 1; k <= 3; ++k)
    mustRun("bake" + options(std::to_string(k) + ".part") + "--part " + std::to_string(k) + "/3");
  mustRun("merge 3.part 1.part -o two.part --quiet");
  mustRun("merge 2.part two.part -o merged.dlm --complete --quiet");
  EXPECT_TRUE(same("merged.dlm", "whole.dlm"));
  EXPECT_EQ(nlohmann::json::parse(run("info two.part --json").out)["direct"]["samples"], 8);
  const auto gaps = run("merge 3.part 1.part -o maps.dlm --complete");
  EXPECT_EQ(gaps.code, 4);
  EXPECT_NE(gaps.err.find("samples of direct light 4..8"), std::string::npos) << gaps.err;
  EXPECT_NE(gaps.err.find("--direct gathered --direct-samples 12 --part 2/3"), std::string::npos) << gaps.err;
  EXPECT_EQ(run("merge 1.part 1.part -o maps.dlm").code, 4);
}

TEST_F(Gathered, DirectLightAloneNeedsNoPhotons) {
  mustRun("bake" + options("whole.dlm") + "--light direct --report whole.json");
  const auto report = nlohmann::json::parse(test::slurp(folder_ / "whole.json"));
  EXPECT_EQ(report["photons"], 0);
  EXPECT_GT(report["map_bytes"], 0);
  for (int k = 1; k <= 2; ++k)
    mustRun("bake" + options(std::to_string(k) + ".part") + "--light direct --part " + std::to_string(k) + "/2");
  mustRun("merge 1.part 2.part -o merged.dlm --complete --quiet");
  EXPECT_TRUE(same("merged.dlm", "whole.dlm"));
}

TEST_F(Gathered, KilledAndResumedGivesTheBitsOfTheUndisturbed) {
  mustRun("bake" + options("whole.dlm") + "--threads 2");
  const std::string line = "\"$LUCARNE\" bake" + options("room.dlm") + "--threads 1 --checkpoint 0.01s --resume";
  for (int i = 0; i < 5; ++i) {
    test::Background bake(folder_, line);
    std::this_thread::sleep_for(std::chrono::milliseconds(120 + 40 * i));
    bake.kill();
  }
  ASSERT_EQ(shell(line).code, 0);
  EXPECT_TRUE(same("room.dlm", "whole.dlm"));
  ASSERT_EQ(shell(line).code, 0) << "finished already";
}

TEST_F(Gathered, AKeptPartTakesMorePhotonsAndSamples) {
  mustRun("bake" + options("room.dlm") + "--keep-part");
  const std::string more = "--direct-samples 18 --photons 300k";
  mustRun("bake" + options("room.dlm", more) + "--keep-part --resume");
  mustRun("bake" + options("whole.dlm", more));
  EXPECT_TRUE(same("room.dlm", "whole.dlm"));
}

TEST_F(Gathered, TeamsOfRanksGiveTheSameBits) {
#ifndef LUCARNE_HAS_MPI
  GTEST_SKIP() << "built without MPI";
#endif
  if (std::system("command -v mpirun >/dev/null") != 0) GTEST_SKIP() << "mpirun is not installed (openmpi-bin)";
  mustRun("bake" + options("whole.dlm"));
  const std::string mpirun =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ASAN_OPTIONS=detect_leaks=0 timeout -k 5 200 mpirun "
      "--oversubscribe --bind-to none ";
  for (const int ranks : {2, 3}) {
    const auto o = shell(mpirun + "-n " + std::to_string(ranks) + " \"$LUCARNE\" bake" + options("team.dlm") +
                         "--threads 1 --checkpoint 0.05s");
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_TRUE(same("team.dlm", "whole.dlm")) << ranks;
  }
}

}  // namespace
}  // namespace lucarne::direct_test
