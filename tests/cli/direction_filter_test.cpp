// --direction-filter through the program: pieces, states, plans, and what may not be put together.
#include "tests/cli/program.h"

namespace lucarne::direction_filter_test {
namespace {

using test::kQuickScene;

class DirectionFilters : public test::ProgramTest {
 protected:
  static std::string bake(const std::string& rest) {
    return std::string("bake") + kQuickScene + "--density 3 --quiet " + rest;
  }
  static std::string linear(const std::string& rest) { return bake("--direction-filter linear " + rest); }
};

TEST_F(DirectionFilters, PartsMergedAreOneBakeBitForBit) {
  for (const char* direct : {"", " --direct gathered --direct-samples 12 --moments"}) {
    mustRun(linear("--photons 40k -o whole.dlm") + direct);
    for (const char* part : {"1", "2", "3"})
      mustRun(linear("--photons 40k -o p") + part + ".part --part " + part + "/3" + direct);
    mustRun("merge p3.part p1.part p2.part -o merged.dlm --quiet");
    EXPECT_EQ(contentHash("merged.dlm"), contentHash("whole.dlm"));
    for (const char* file : {"irradiance.exr", "directional.exr"})
      EXPECT_TRUE(same(std::string("merged.dlm/") + file, std::string("whole.dlm/") + file)) << file;
  }
}

TEST_F(DirectionFilters, OfTwoKindsAreNotOfOneBake) {
  mustRun(linear("--photons 4k -o a.part --part 1/2"));
  mustRun(bake("--photons 4k -o b.part --part 2/2"));
  const auto refused = run("merge a.part b.part -o out.dlm");
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("a.part and b.part differ in direction_filter"), std::string::npos) << refused.err;
  mustRun(linear("--photons 4k -o room.dlm --keep-part"));
  const auto other = run(bake("--photons 8k -o room.dlm --keep-part --resume"));
  EXPECT_EQ(other.code, 4);
  EXPECT_NE(other.err.find("differ in direction_filter"), std::string::npos) << other.err;
}

TEST_F(DirectionFilters, GoingOnGivesTheBitsOfOneBake) {
  mustRun(linear("--photons 60k -o whole.dlm"));
  mustRun(linear("--photons 25k -o room.dlm --keep-part"));
  mustRun(linear("--photons 60k -o room.dlm --keep-part --resume"));
  EXPECT_EQ(contentHash("room.dlm"), contentHash("whole.dlm"));
}

TEST_F(DirectionFilters, ThatIsTheDefaultHasTheHashesOfABakeThatNamesNone) {
  mustRun(bake("--photons 9k -o a.dlm --report a.json"));
  mustRun(bake("--photons 9k -o b.dlm --report b.json --direction-filter nearest"));
  mustRun(linear("--photons 9k -o c.dlm --report c.json"));
  const auto hashes = [&](const char* report) {
    const auto told = nlohmann::json::parse(test::slurp(folder_ / report));
    return told["settings_hash"].get<std::string>() + told["content_hash"].get<std::string>();
  };
  EXPECT_EQ(hashes("a.json"), hashes("b.json"));
  EXPECT_NE(hashes("a.json"), hashes("c.json"));
  EXPECT_EQ(test::slurp(folder_ / "a.dlm/manifest.json").find("\"filter\""), std::string::npos);
}

TEST_F(DirectionFilters, AreToldByReportInfoManifestAndPlan) {
  mustRun(linear("--photons 9k -o a.dlm --keep-part --report a.json"));
  EXPECT_EQ(nlohmann::json::parse(test::slurp(folder_ / "a.json"))["settings"]["direction_filter"], "linear");
  for (const char* path : {"a.dlm", "a.part"})
    EXPECT_NE(run(std::string("info ") + path + " --json").out.find("linear"), std::string::npos) << path;
  const auto manifest = nlohmann::json::parse(test::slurp(folder_ / "a.dlm/manifest.json"));
  EXPECT_EQ(manifest["directions"]["filter"], "linear");
  mustRun(std::string("check") + kQuickScene + "--density 3 --photons 9k --direction-filter linear --plan plan.json");
  mustRun("bake --plan plan.json -o b.part --quiet");
  EXPECT_EQ(contentHash("b.part"), contentHash("a.part"));
  const auto refused = run("bake --plan plan.json --direction-filter nearest -o c.part --quiet");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--direction-filter contradicts plan.json"), std::string::npos) << refused.err;
}

TEST_F(DirectionFilters, LeaveTheIrradianceAsItIsAndAreNotComparedByDirection) {
  mustRun(linear("--photons 9k -o a.dlm"));
  mustRun(bake("--photons 9k -o b.dlm"));
  EXPECT_TRUE(same("a.dlm/irradiance.exr", "b.dlm/irradiance.exr"));
  EXPECT_NE(run("compare a.dlm b.dlm").out.find("linear and nearest: of different filters"), std::string::npos);
}

TEST_F(DirectionFilters, ThatNobodyKnowsAreRefused) {
  const auto typed = run(bake("--photons 9k -o a.dlm --direction-filter cubic"));
  EXPECT_EQ(typed.code, 2);
  EXPECT_NE(typed.err.find("'cubic' is none of linear, nearest"), std::string::npos) << typed.err;
  mustRun(linear("--photons 9k -o a.dlm"));
  ASSERT_EQ(shell("sed -i 's/\"filter\":\\s*\"linear\"/\"filter\": \"cubic\"/' a.dlm/manifest.json").code, 0);
  const auto probed = shell("echo 0 0 0 0 1 0 | \"$LUCARNE\" probe a.dlm --json");
  EXPECT_EQ(probed.code, 3);
  EXPECT_NE(probed.err.find("filter"), std::string::npos) << probed.err;
}

}  // namespace
}  // namespace lucarne::direction_filter_test
