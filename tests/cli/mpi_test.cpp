// Ranks of an MPI job give the bits of one process, end together, and go on after one of them died.
#include <algorithm>
#include <random>

#include "tests/cli/program.h"

namespace lucarne::mpi_test {
namespace {

namespace fs = std::filesystem;
using test::kQuickScene;

class Mpi : public test::ProgramTest {
 protected:
  void SetUp() override {
#ifndef LUCARNE_HAS_MPI
    GTEST_SKIP() << "built without MPI";
#endif
    if (std::system("command -v mpirun >/dev/null") != 0) GTEST_SKIP() << "mpirun is not installed (openmpi-bin)";
    ProgramTest::SetUp();
  }

  /// mpirun as root and with more ranks than cores; MPI's own leaks are not ours. `timeout`: a hang is a failure.
  static std::string mpirun() {
    return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ASAN_OPTIONS=detect_leaks=0 "
           "timeout -k 5 200 mpirun --oversubscribe --bind-to none ";
  }
  /// Of the job that runs in the test's folder; 0: not found.
  pid_t pidOfRank(int rank) const {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator("/proc", none)) {
      if (fs::read_symlink(entry.path() / "cwd", none) != fs::canonical(folder_)) continue;
      const std::string variable = std::string(1, '\0') + "OMPI_COMM_WORLD_RANK=" + std::to_string(rank) + '\0';
      if ((std::string(1, '\0') + test::slurp(entry.path() / "environ")).find(variable) != std::string::npos)
        return static_cast<pid_t>(std::stol(entry.path().filename().string()));
    }
    return 0;
  }
  static std::string bake(const std::string& output, const std::string& photons) {
    return std::string("\"$LUCARNE\" bake") + kQuickScene + "--density 10 --quiet -o " + output + " --photons " +
           photons + " ";
  }
};

struct Team {
  int ranks, threads;
};
class MpiTeams : public Mpi, public testing::WithParamInterface<Team> {};

TEST_P(MpiTeams, GiveEveryFileBitForBit) {
  const auto [ranks, threads] = GetParam();
  ASSERT_EQ(shell(bake("whole.dlm", "300k") + "--threads 2").code, 0);
  const auto o = shell(mpirun() + "-n " + std::to_string(ranks) + " " + bake("team.dlm", "300k") +
                       "--report team.json --threads " + std::to_string(threads));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(contentHash("team.dlm"), contentHash("whole.dlm"));
  EXPECT_TRUE(same("team.dlm", "whole.dlm"));
  EXPECT_EQ(nlohmann::json::parse(test::slurp(folder_ / "team.json"))["photons"], 300'000);
}
INSTANTIATE_TEST_SUITE_P(RanksAndThreads, MpiTeams,
                         testing::Values(Team{1, 1}, Team{1, 2}, Team{1, 3}, Team{2, 1}, Team{2, 2}, Team{2, 3},
                                         Team{3, 1}, Team{3, 2}, Team{3, 3}, Team{5, 1}, Team{5, 2}, Team{5, 3}),
                         [](const auto& team) {
                           return std::to_string(team.param.ranks) + "Ranks" + std::to_string(team.param.threads) +
                                  "Threads";
                         });

TEST_F(Mpi, SharedHitsAreThoseOfOneProcess) {
  const std::string options = "--direction-filter linear --moments --threads 1";
  ASSERT_EQ(shell(bake("whole.dlm", "200k") + options).code, 0);
  ASSERT_EQ(shell(mpirun() + "-n 3 " + bake("team.dlm", "200k") + options).code, 0);
  EXPECT_TRUE(same("team.dlm", "whole.dlm"));
}

TEST_F(Mpi, PartsOfTeamsOfAnySizeMergeToTheBakeOfOne) {
  ASSERT_EQ(shell(bake("whole.dlm", "200k")).code, 0);
  std::mt19937 random(3);
  std::string inputs;
  for (int k = 1; k <= 5; ++k) {
    const std::string name = "p" + std::to_string(k) + ".part",
                      ranks = std::to_string(std::array{1, 2, 3, 5}[random() % 4]);
    const auto o = shell(mpirun() + "-n " + ranks + " " + bake(name, "200k") + "--threads " +
                         std::to_string(1 + random() % 3) + " --part " + std::to_string(k) + "/5");
    ASSERT_EQ(o.code, 0) << o.err;
    inputs = (random() % 2 == 0 ? inputs + " " + name : name + " " + inputs);
  }
  mustRun("merge --quiet --complete -o merged.dlm " + inputs);
  EXPECT_TRUE(same("merged.dlm", "whole.dlm"));
}

TEST_F(Mpi, CheckpointsOnTheWayChangeNothing) {
  ASSERT_EQ(shell(bake("whole.dlm", "1M")).code, 0);
  const auto o = shell(mpirun() + "-n 3 " + bake("team.dlm", "1M") + "--threads 1 --checkpoint 0.01s");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(same("team.dlm", "whole.dlm"));
  EXPECT_FALSE(exists("team.checkpoint"));
}

TEST_F(Mpi, AKilledRankEndsTheJobWhichGoesOnWithFewerToTheSameBits) {
  test::Background job(folder_,
                       "env " + mpirun() + "-n 3 " + bake("team.dlm", "1G") + "--threads 1 --checkpoint 0.05s");
  const auto states = [this] {
    std::error_code none;
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "team.checkpoint", none))
      if (entry.path().extension() == ".part") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  };
  while (job.running() && states().empty()) ::usleep(2000);
  ASSERT_TRUE(job.running());
  // One rank, not the launcher: the newest of the processes.
  ASSERT_EQ(shell("pkill -KILL -n -f 'quiet -o team[.]dlm --photons 1G'").code, 0);
  EXPECT_NE(job.exitCode(), 0);
  ASSERT_FALSE(states().empty());
  const auto o = run("info team.checkpoint/" + states().back() + " --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string enough = std::to_string(nlohmann::json::parse(o.out)["photons"].get<std::uint64_t>() + 100'000);
  const auto resumed = shell(mpirun() + "-n 2 " + bake("team.dlm", enough) + "--resume");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  ASSERT_EQ(shell(bake("whole.dlm", enough)).code, 0);
  EXPECT_TRUE(same("team.dlm", "whole.dlm"));
}

TEST_F(Mpi, ASignalToAnyRankStopsAllAlikeWithTheStateSaved) {
  for (const int rank : {2, 0}) {
    fs::remove(folder_ / "team.checkpoint" / "lock");  // it tells that the next one has begun
    test::Background job(folder_, "env " + mpirun() + "-n 3 " + bake("team.dlm", "100G") + "--threads 1 --resume");
    while (job.running() && !exists("team.checkpoint/lock")) ::usleep(2000);
    ::usleep(300'000);
    const pid_t told = pidOfRank(rank);
    ASSERT_GT(told, 0);
    ::kill(told, SIGTERM);
    EXPECT_EQ(job.exitCode(), 130) << test::slurp(folder_ / "log");
    EXPECT_NE(test::slurp(folder_ / "log").find("photons are saved in team.checkpoint"), std::string::npos)
        << test::slurp(folder_ / "log");
  }
  const auto o = run("info \"$(ls team.checkpoint/*.part | tail -n 1)\" --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string enough = std::to_string(nlohmann::json::parse(o.out)["photons"].get<std::uint64_t>() + 100'000);
  const auto resumed = shell(mpirun() + "-n 2 " + bake("team.dlm", enough) + "--resume");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  ASSERT_EQ(shell(bake("whole.dlm", enough)).code, 0);
  EXPECT_TRUE(same("team.dlm", "whole.dlm"));
}

TEST_F(Mpi, APreviewIsWrittenWhileTheRanksTrace) {
  test::Background job(folder_, "env " + mpirun() + "-n 2 " + bake("team.dlm", "100G") + "--threads 1");
  while (job.running() && !exists("team.checkpoint/lock")) ::usleep(2000);
  ::usleep(200'000);
  const pid_t first = pidOfRank(0);
  ASSERT_GT(first, 0);
  ::kill(first, SIGUSR1);
  while (job.running() && !exists("team.preview.dlm/manifest.json")) ::usleep(2000);
  ASSERT_TRUE(job.running()) << test::slurp(folder_ / "log");
  const auto o = run("info team.preview.dlm --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string photons = std::to_string(nlohmann::json::parse(o.out)["photons"].get<std::uint64_t>());
  job.kill();
  ASSERT_EQ(shell(bake("whole.dlm", photons)).code, 0);
  EXPECT_EQ(contentHash("team.preview.dlm"), contentHash("whole.dlm"));
}

TEST_F(Mpi, TheTargetEndsAtTheSamePhotonAsOnOneProcess) {
  const std::string target = " --density 4 --target-error 2% ";
  const std::string quick = std::string("\"$LUCARNE\" bake") + kQuickScene + "--quiet" + target;
  ASSERT_EQ(shell(quick + "-o whole.dlm").code, 0);
  const auto o = shell(mpirun() + "-n 3 " + quick + "-o team.dlm --threads 1");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(same("team.dlm", "whole.dlm"));
}

TEST_F(Mpi, AnErrorOfTheFirstRankIsToldOnceAndEndsAll) {
  const auto o = shell(mpirun() + "-n 3 \"$LUCARNE\" bake nothere.glb -o x.dlm");
  EXPECT_EQ(o.code, 3);
  const std::size_t first = o.err.find("lucarne: cannot read nothere.glb");
  ASSERT_NE(first, std::string::npos) << o.err;
  EXPECT_EQ(o.err.find("lucarne: ", first + 1), std::string::npos) << "told once: " << o.err;
}

TEST_F(Mpi, RanksThatWereStartedDifferentlyAreRefused) {
  const auto o = shell(mpirun() + "-n 1 " + bake("x.dlm", "100k") + ": -n 1 " + bake("x.dlm", "100k") + "--seed 4");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("ranks 0 and 1 differ in seed: 0 and 4"), std::string::npos) << o.err;
  EXPECT_FALSE(exists("x.dlm"));
}

TEST_F(Mpi, AnErrorOfAnotherRankEndsAllWithItsMessage) {
  const auto o =
      shell(mpirun() + "-n 2 " + bake("x.dlm", "100k") + ": -n 1 " + bake("x.dlm", "100k") + "--isa nonsense");
  EXPECT_NE(o.code, 0);
  EXPECT_NE(o.err.find("lucarne: rank 2: --isa"), std::string::npos) << o.err;
  EXPECT_FALSE(exists("x.dlm"));
}

TEST_F(Mpi, AnErrorThatTheOthersDoNotKnowOfEndsAllWithItsMessage) {
  if (test::isSanitized()) GTEST_SKIP() << "the address sanitizer needs more memory than the limit of this test";
  // Rank 0 alone writes, and may write nothing larger than a block: it waits for room, until it is told to end.
  const std::string line = bake("x.dlm", "100k") + "--checkpoint 0";
  test::Background job(folder_,
                       "env " + mpirun() + "-n 1 sh -c 'trap \"\" XFSZ; ulimit -f 1; exec " + line + "' : -n 2 " + line);
  while (job.running() && test::slurp(folder_ / "log").find("can be written anywhere") == std::string::npos)
    ::usleep(20'000);
  const pid_t first = pidOfRank(0);
  ASSERT_GT(first, 0) << test::slurp(folder_ / "log");
  ::kill(first, SIGTERM);
  EXPECT_NE(job.exitCode(), 0);
  EXPECT_NE(test::slurp(folder_ / "log").find("lucarne: rank 0: cannot write"), std::string::npos)
      << test::slurp(folder_ / "log");
  EXPECT_FALSE(exists("x.dlm"));
}

TEST_F(Mpi, WithoutALauncherTheProgramDoesNotStartMpi) {
  // With this setting no MPI can start: a process that believes in a launcher fails, one without does not notice.
  const std::string broken = "OMPI_MCA_pml=nonsense ";
  EXPECT_NE(shell(broken + "OMPI_COMM_WORLD_RANK=0 timeout 60 " + bake("x.dlm", "1k")).code, 0);
  EXPECT_EQ(shell(broken + bake("y.dlm", "1k")).code, 0);
  EXPECT_TRUE(exists("y.dlm"));
}

}  // namespace
}  // namespace lucarne::mpi_test
