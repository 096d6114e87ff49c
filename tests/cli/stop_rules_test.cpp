// --photons, --time, --target-error: whichever comes first ends the bake, and the report says which.
#include <sstream>

#include "tests/cli/program.h"

namespace lucarne::stop_rules_test {
namespace {

using nlohmann::json;

class StopRules : public test::ProgramTest {
 protected:
  test::ProgramOutcome bake(const std::string& options) const {
    return run(std::string("bake") + test::kQuickScene + "--density 4 " + options);
  }
  json report(const std::string& name) const { return json::parse(test::slurp(folder_ / name)); }
};

TEST_F(StopRules, TheTargetEndsAtOneCountWhateverTheThreadsAndInterruptions) {
  ASSERT_EQ(bake("-o a.dlm --quiet --target-error 2% --threads 1 --report a.json").code, 0);
  const json a = report("a.json");
  EXPECT_EQ(a["ended_by"], "target_error");
  EXPECT_LE(a["estimated_relative_error"].get<double>(), 0.0201);
  EXPECT_EQ(a["photons"], 1 << 20) << "the first count at which it is judged";
  EXPECT_EQ(a["settings"]["target_error"], 0.02);
  EXPECT_TRUE(a["settings"]["photons"].is_null());
  {
    test::Background other(folder_, std::string("\"$LUCARNE\" bake") + test::kQuickScene +
                                        "--density 4 -o b.dlm --quiet --target-error 2% --threads 2");
    while (other.running() && !exists("b.checkpoint/lock")) ::usleep(1000);
    ::usleep(100'000);
    ::kill(other.pid(), SIGINT);
    const int code = other.exitCode();
    EXPECT_TRUE(code == 130 || code == 0) << code;
  }
  ASSERT_EQ(bake("-o b.dlm --quiet --target-error 2% --threads 3 --resume").code, 0);
  EXPECT_TRUE(same("a.dlm", "b.dlm"));
  // A finished one is not baked again.
  const auto again = bake("-o b.dlm --target-error 2% --resume --report b.json");
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("finished already"), std::string::npos) << again.err;
  EXPECT_EQ(report("b.json")["content_hash"], a["content_hash"]);
}

TEST_F(StopRules, TimeEndsWithAWholeResult) {
  const auto o = bake("-o a.dlm --time 1s --report a.json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("the time was up"), std::string::npos) << o.err;
  const json a = report("a.json");
  EXPECT_EQ(a["ended_by"], "time");
  EXPECT_EQ(a["settings"]["time_seconds"], 1.0);
  EXPECT_GE(a["photons"].get<std::uint64_t>(), 1u << 17);
  EXPECT_TRUE(a["ledger_balances"].get<bool>());
  ASSERT_EQ(bake("-o b.dlm --quiet --photons " + std::to_string(a["photons"].get<std::uint64_t>())).code, 0);
  EXPECT_EQ(contentHash("a.dlm"), contentHash("b.dlm"));
  EXPECT_EQ(run("probe a.dlm --json < /dev/null").code, 0);
}

TEST_F(StopRules, TimeOfEarlierRunsCounts) {
  {
    test::Background first(folder_, std::string("\"$LUCARNE\" bake") + test::kQuickScene +
                                        "--density 4 -o a.dlm --quiet --time 100h --checkpoint 0.05s");
    while (first.running() && !exists("a.checkpoint/state-000003.part")) ::usleep(1000);
    ::kill(first.pid(), SIGTERM);
    ASSERT_EQ(first.exitCode(), 130);
  }
  // More than a millisecond was traced: with less time asked for than that, what is there is made a result.
  ASSERT_EQ(bake("-o a.dlm --quiet --time 0.001s --resume --report a.json").code, 0);
  const json a = report("a.json");
  EXPECT_EQ(a["ended_by"], "time");
  EXPECT_GE(a["photons"].get<std::uint64_t>(), 1u << 17);
}

TEST_F(StopRules, PhotonsComeFirstWhereTheyAreFew) {
  ASSERT_EQ(bake("-o a.dlm --quiet --photons 20k --time 8h --target-error 0.001% --report a.json").code, 0);
  EXPECT_EQ(report("a.json")["ended_by"], "photons");
  EXPECT_EQ(report("a.json")["photons"], 20'000);
}

TEST_F(StopRules, NonsenseIsRefusedWithTwo) {
  for (const char* options : {"--time 8", "--time soon", "--time 0s", "--time -1h", "--target-error 0",
                              "--target-error 2.5.1%", "--target-error 150%", "--target-error low", "--photons 20X",
                              "--photons -3", "--photons 0.5", "--memory lots", "--memory 0", "--checkpoint 5",
                              "--progress bars", "--time 1h --part 1/2", "--target-error 1% --part 1/2 --photons 1M",
                              "--target-error 1% --photon-range 0:1k", "--time 1h --light direct --direct gathered"}) {
    const auto o = bake(std::string("-o a.dlm ") + options);
    EXPECT_EQ(o.code, 2) << options << "\n" << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << options << "\n" << o.err;
  }
  EXPECT_FALSE(exists("a.dlm"));
}

TEST_F(StopRules, ProgressAsJsonIsAnObjectALine) {
  const auto o = bake("-o a.dlm --photons 300k --progress json --quiet");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  std::istringstream lines(o.out);
  json last;
  for (std::string line; std::getline(lines, line);) last = json::parse(line);
  EXPECT_EQ(last["phase"], "traced");
  EXPECT_EQ(last["photons"], 300'000);
  EXPECT_EQ(last["fraction"], 1.0);
}

TEST_F(StopRules, AReaderOfTheProgressThatGoesAwayEndsNothing) {
  const auto o = shell(std::string("{ \"$LUCARNE\" bake") + test::kQuickScene +
                       "--density 4 -o a.dlm --photons 300k --progress json; echo $? > code; } | true");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(test::slurp(folder_ / "code"), "0\n") << o.err;
  EXPECT_TRUE(exists("a.dlm"));
}

}  // namespace
}  // namespace lucarne::stop_rules_test
