// --moments through the program: pieces, states and what may not be put together.
#include "tests/cli/program.h"

namespace lucarne::moments_test {
namespace {

using test::kQuickScene;

class Moments : public test::ProgramTest {
 protected:
  static std::string bake(const std::string& rest) {
    return std::string("bake") + kQuickScene + "--density 3 --moments --quiet " + rest;
  }
};

TEST_F(Moments, PartsMergedAreOneBakeBitForBit) {
  for (const char* direct : {"", " --direct gathered --direct-samples 12"}) {
    mustRun(bake("--photons 40k -o whole.dlm") + direct);
    for (const char* part : {"1", "2", "3"})
      mustRun(bake("--photons 40k -o p") + part + ".part --part " + part + "/3" + direct);
    mustRun("merge p3.part p1.part p2.part -o merged.dlm --quiet");
    EXPECT_EQ(contentHash("merged.dlm"), contentHash("whole.dlm"));
    for (const char* file : {"irradiance.exr", "directional.exr", "moments.exr"})
      EXPECT_TRUE(same(std::string("merged.dlm/") + file, std::string("whole.dlm/") + file)) << file;
    mustRun("merge p2.part p3.part -o some.part --quiet");
    mustRun("merge some.part p1.part -o tree.dlm --quiet");
    EXPECT_TRUE(same("tree.dlm/moments.exr", "whole.dlm/moments.exr"));
  }
}

TEST_F(Moments, GoingOnGivesTheBitsOfOneBake) {
  mustRun(bake("--photons 60k -o whole.dlm"));
  mustRun(bake("--photons 25k -o room.dlm --keep-part"));
  mustRun(bake("--photons 60k -o room.dlm --keep-part --resume"));
  EXPECT_EQ(contentHash("room.dlm"), contentHash("whole.dlm"));
  EXPECT_TRUE(same("room.dlm/moments.exr", "whole.dlm/moments.exr"));
}

TEST_F(Moments, AKilledBakeGoesOnToTheSameBits) {
  {
    test::Background killed(folder_, "\"$LUCARNE\" " + bake("--photons 1G -o room.dlm --checkpoint 0.05s"));
    while (killed.running() && !exists("room.checkpoint/state-000002.part")) ::usleep(1000);
    killed.kill();
  }
  const auto newest = shell("ls room.checkpoint/*.part | tail -n 1 | tr -d '\\n'").out;
  const auto state = nlohmann::json::parse(run("info " + newest + " --json").out);
  EXPECT_GT(state["moment_entries"].get<std::uint64_t>(), 0u);
  const std::string photons = std::to_string(state["photons"].get<std::uint64_t>() + 30'000);
  mustRun(bake("--photons " + photons + " -o room.dlm --resume"));
  mustRun(bake("--photons " + photons + " -o whole.dlm"));
  EXPECT_EQ(contentHash("room.dlm"), contentHash("whole.dlm"));
  EXPECT_TRUE(same("room.dlm/moments.exr", "whole.dlm/moments.exr"));
}

TEST_F(Moments, PartsWithAndWithoutAreNotOfOneBake) {
  mustRun(bake("--photons 4k -o a.part --part 1/2"));
  mustRun(std::string("bake") + kQuickScene + "--density 3 --quiet --photons 4k -o b.part --part 2/2");
  const auto refused = run("merge a.part b.part -o out.dlm");
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("a.part and b.part differ in moments"), std::string::npos) << refused.err;
}

TEST_F(Moments, WithoutThemNothingSaysOfThem) {
  mustRun(std::string("bake") + kQuickScene + "--density 3 --quiet --photons 4k -o a.dlm --keep-part");
  EXPECT_FALSE(exists("a.dlm/moments.exr"));
  EXPECT_EQ(run("info a.part --json").out.find("moment"), std::string::npos);
}

}  // namespace
}  // namespace lucarne::moments_test
