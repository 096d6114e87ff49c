// --report as a user gets it: JSON and page, across kills, and a command that bakes the same again.
#include "tests/cli/program.h"
#include "tests/support/changed_scene.h"

namespace lucarne::test::report_test {
namespace {

using nlohmann::json;

class ReportProgram : public ProgramTest {
 protected:
  json report(const std::string& name) const { return json::parse(slurp(folder_ / name)); }
  std::string page(const std::string& name) const { return slurp(folder_ / name); }
};

constexpr const char* kSmall = "--photons 50k --density 8 --quiet ";

TEST_F(ReportProgram, WritesJsonAndPageWhicheverIsNamed) {
  mustRun(std::string("bake") + kQuickScene + kSmall + "-o a.dlm --report a.html");
  mustRun(std::string("bake") + kQuickScene + kSmall + "-o b.dlm --report b.json");
  for (const std::string name : {"a", "b"}) {
    EXPECT_EQ(report(name + ".json")["photons"], 50'000);
    const std::string html = page(name + ".html");
    EXPECT_NE(html.find("camera 0 &#39;published&#39;"), std::string::npos) << "its picture";
    EXPECT_NE(html.find("estimated relative error"), std::string::npos) << "the error map";
    EXPECT_EQ(html.find("http:"), std::string::npos);
    EXPECT_EQ(html.find("https:"), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
  }
  const auto o = run(std::string("bake") + kQuickScene + kSmall + "-o c.dlm --report /dev/stdout");
  EXPECT_EQ(json::parse(o.out)["photons"], 50'000) << "JSON alone, to wherever it is told";
}

TEST_F(ReportProgram, LightMapsDoNotDependOnIt) {
  mustRun(std::string("bake") + kQuickScene + kSmall + "-o a.dlm --report a.html");
  mustRun(std::string("bake") + kQuickScene + kSmall + "-o b.dlm");
  EXPECT_TRUE(same("a.dlm", "b.dlm"));
}

TEST_F(ReportProgram, NamesOfTheSceneAreTextOnThePage) {
  writeChangedCornellBox(folder_ / "box.glb", [](Json& j) {
    j["cameras"][0]["name"] = "<script>alert('camera')</script>";
    j["nodes"][8]["name"] = "<script>alert('camera')</script>";
    for (Json& m : j["materials"]) m["name"] = "\"><img src=x onerror=alert(1)>";
  });
  mustRun("bake box.glb --photons 2k --density 8 --quiet -o a.dlm --report a.html");
  const std::string html = page("a.html");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<img src=x"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(&#39;camera&#39;)"), std::string::npos);
  EXPECT_NE(html.find("&quot;&gt;&lt;img src=x"), std::string::npos) << "the lamp's material, and that of few photons";
}

TEST_F(ReportProgram, ItsCommandBakesTheSameAgain) {
  std::filesystem::create_directories(folder_ / "it's here");
  std::filesystem::copy(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb", folder_ / "it's here" / "a room.glb");
  mustRun(
      "bake \"it's here/a room.glb\" -o 'my maps.dlm' --photons 30k --density 9.5 --directions 6 --seed 7 --kernel box "
      "--kernel-width 2 --seams keep --format float --light indirect --sampler random --texels 500k --quiet "
      "--report r.json");
  const json first = report("r.json");
  const std::string command = first["command"];
  ASSERT_EQ(command.substr(0, 8), "lucarne ");
  const auto o = shell("mv 'my maps.dlm' first.dlm && \"$LUCARNE\" " + command.substr(8) + " --quiet");
  ASSERT_EQ(o.code, 0) << command << "\n" << o.err;
  EXPECT_TRUE(same("first.dlm", "'my maps.dlm'")) << command;
}

TEST_F(ReportProgram, CurveOfTheRatesOutlivesAKill) {
  const std::string bake = std::string("bake") + kQuickScene + "-o room.dlm --density 8 --checkpoint 0.05s --quiet ";
  std::uint64_t before = 0;
  {
    Background killed(folder_, "\"$LUCARNE\" " + bake + "--photons 1G");
    const auto states = [&] { return shell("ls room.checkpoint/*.part").code == 0; };
    while (killed.running() && !states()) ::usleep(10'000);
    killed.kill();
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "room.checkpoint")) {
      const auto o = run("info room.checkpoint/" + entry.path().filename().string() + " --json");
      if (o.code == 0) before = std::max(before, json::parse(o.out)["photons"].get<std::uint64_t>());
    }
  }
  ASSERT_GT(before, 0u);
  mustRun(bake + "--resume --report r.json --photons " + std::to_string(before + 100'000));
  const json curve = report("r.json")["rate_curve"];
  ASSERT_EQ(curve["seconds"].size(), curve["photons"].size());
  ASSERT_LE(curve["seconds"].size(), 500u);
  EXPECT_EQ(curve["photons"].front(), 0) << "from the beginning of the first run";
  EXPECT_EQ(curve["photons"].back(), before + 100'000);
  EXPECT_TRUE(std::is_sorted(curve["photons"].begin(), curve["photons"].end()));
  EXPECT_TRUE(std::is_sorted(curve["seconds"].begin(), curve["seconds"].end()));
}

TEST_F(ReportProgram, TellsOfLightsWarningsAndTheMachine) {
  mustRun(std::string("bake") + kQuickScene + "--photons 200 --density 16 --quiet -o a.dlm --report a.json");
  const json r = report("a.json");
  ASSERT_EQ(r["lights"].size(), 1u);
  EXPECT_EQ(r["lights"][0]["kind"], "emissive");
  EXPECT_GT(r["host"]["memory_bytes"], 0);
  EXPECT_EQ(r["builds"].size(), 1u);
  bool few = false;
  for (const json& w : r["warnings"]) few = few || w["id"] == "few_photons";
  EXPECT_TRUE(few) << r["warnings"];
}

TEST_F(ReportProgram, OfAMergeIsThatOfTheBake) {
  const std::string bake = std::string("bake") + kQuickScene + kSmall;
  mustRun(bake + "-o whole.dlm --report whole.json");
  mustRun(bake + "-o a.part --part 1/2 --report part.html");
  mustRun(bake + "-o b.part --part 2/2");
  mustRun("merge a.part b.part -o merged.dlm --quiet --report merged.html");
  EXPECT_TRUE(same("whole.dlm", "merged.dlm"));
  const json whole = report("whole.json"), merged = report("merged.json");
  for (const char* key : {"lights", "warnings", "content_hash", "flux_lm", "settings"})
    EXPECT_EQ(whole[key], merged[key]) << key;
  EXPECT_NE(page("merged.html").find("camera 0"), std::string::npos);
  EXPECT_NE(page("part.html").find("path traced"), std::string::npos) << "a part has no light maps to draw";
  EXPECT_NE(page("part.html").find("estimated relative error"), std::string::npos);
}

}  // namespace
}  // namespace lucarne::test::report_test
