// A plan made once, baked in pieces anywhere.
#include "tests/cli/program.h"
#include "tests/support/changed_scene.h"

namespace lucarne::test::plan_test {
namespace {

using nlohmann::json;

class PlanProgram : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    std::filesystem::create_directories(folder_ / "job");
    writeChangedCornellBox(folder_ / "job" / "box.glb", [](Json&) {});
  }
  void expectRefused(const std::string& arguments, int code, const std::string& words) const {
    const auto o = run(arguments);
    EXPECT_EQ(o.code, code) << arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(words), std::string::npos) << arguments << "\n" << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  }
};

constexpr const char* kSettings =
    " --photons 60k --density 8 --directions 6 --seed 9 --kernel box --seams keep --format float --sampler random "
    "--light "
    "indirect ";

TEST_F(PlanProgram, GivesThePartsOfOneBakeWithoutAnyOtherOption) {
  mustRun(std::string("check job/box.glb --plan job/plan.json") + kSettings);
  for (const char* k : {"1", "2", "3"})
    mustRun(std::string("bake --plan job/plan.json --part ") + k + "/3 -o " + k + ".part --quiet");
  mustRun("merge 1.part 2.part 3.part --complete --format float -o merged.dlm --quiet");
  mustRun(std::string("bake job/box.glb -o whole.dlm --quiet") + kSettings);
  EXPECT_TRUE(same("merged.dlm", "whole.dlm"));
  mustRun("bake --plan job/plan.json -o planned.dlm --quiet");
  EXPECT_TRUE(same("planned.dlm", "whole.dlm"));
}

TEST_F(PlanProgram, MovesWithItsFolderAndTakesASceneThatIsNamed) {
  mustRun("check job/box.glb --plan job/plan.json --photons 20k --density 8");
  ASSERT_EQ(shell("mv job moved && cp moved/box.glb elsewhere.glb").code, 0);
  mustRun("bake --plan moved/plan.json -o a.dlm --quiet");
  ASSERT_EQ(shell("rm moved/box.glb").code, 0);
  expectRefused("bake --plan moved/plan.json -o b.dlm --quiet", 3, "moved/box.glb");
  mustRun("bake elsewhere.glb --plan moved/plan.json -o b.dlm --quiet");
  EXPECT_EQ(contentHash("a.dlm"), contentHash("b.dlm"));
}

TEST_F(PlanProgram, RefusesWhatContradictsItInOneLine) {
  mustRun(std::string("check job/box.glb --plan job/plan.json") + kSettings);
  const std::string bake = "bake --plan job/plan.json -o a.dlm ";
  expectRefused(bake + "--density 16", 2, "--density contradicts job/plan.json, which has texels_per_metre 8.0");
  expectRefused(bake + "--seed 8", 2, "--seed contradicts");
  expectRefused(bake + "--photons 1M", 2, "--photons contradicts");
  expectRefused(bake + "--no-guide", 2, "--no-guide contradicts");
  expectRefused(bake + "--kernel pyramid", 2, "which has kernel \"box\"");
  expectRefused(bake + "--format half", 2, "--format contradicts");
  expectRefused(bake + "--isa sse4.2", 2, "--isa contradicts");
  EXPECT_FALSE(exists("a.dlm"));
  mustRun(bake + "--density 8 --seed 9 --kernel box --threads 1 --quiet");
}

TEST_F(PlanProgram, RefusesAnotherSceneButNotOtherCameras) {
  mustRun("check job/box.glb --plan job/plan.json --photons 20k --density 8");
  writeChangedCornellBox(folder_ / "red.glb", [](Json& j) { j["materials"][3]["doubleSided"] = true; });
  writeChangedCornellBox(folder_ / "view.glb", [](Json& j) { changeWhatLightDoesNotTouch(j); });
  expectRefused("bake red.glb --plan job/plan.json -o a.dlm --quiet", 4,
                "job/plan.json and this bake differ in scene: ");
  mustRun("bake view.glb --plan job/plan.json -o a.dlm --quiet");
}

TEST_F(PlanProgram, FilesThatAreNoPlanAreBadInput) {
  std::ofstream(folder_ / "a.json") << "{\"format\":\"lucarne-part\"}";
  std::ofstream(folder_ / "b.json") << "nonsense";
  expectRefused("bake --plan a.json -o a.dlm", 3, "a.json: format is not that of a plan");
  expectRefused("bake --plan b.json -o a.dlm", 3, "b.json");
  expectRefused("bake --plan nowhere.json -o a.dlm", 3, "nowhere.json");
  mustRun("check job/box.glb --plan job/plan.json --photons 20k");
  json plan = json::parse(slurp(folder_ / "job" / "plan.json"));
  plan["settings"]["directions"] = 100'000;
  std::ofstream(folder_ / "c.json") << plan;
  expectRefused("bake job/box.glb --plan c.json -o a.dlm", 3, "c.json");
}

}  // namespace
}  // namespace lucarne::test::plan_test
