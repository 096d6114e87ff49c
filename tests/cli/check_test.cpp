// lucarne check as a user runs it.
#include <algorithm>

#include "tests/cli/program.h"

namespace lucarne::test::check_test {
namespace {

using nlohmann::json;

class CheckProgram : public ProgramTest {
 protected:
  json check(const std::string& arguments) const {
    const ProgramOutcome o = run("check --json " + arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err, "");
    return json::parse(o.out);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  static bool warned(const json& checked, const std::string& id) {
    for (const json& w : checked["warnings"])
      if (w["id"] == id) return true;
    return false;
  }
};

/// One triangle of a square metre and a half, with `members` of the document beside.
std::string triangle(const std::string& members) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])" +
         members + "}";
}

TEST_F(CheckProgram, JsonHasTheAgreedKeys) {
  const json c = check("");
  for (const char* key : {"kind", "program", "scene", "modelled", "left_out", "lights", "uv", "layout", "resources",
                          "time", "settings", "warnings", "surfaces", "failures", "plan"})
    EXPECT_TRUE(c.contains(key)) << key;
  for (const char* key : {"tally_bytes", "expected_peak_memory_bytes", "free_memory_bytes", "map_bytes", "dlm_bytes",
                          "checkpoint_bytes", "free_disk_bytes"})
    EXPECT_GT(c["resources"][key].get<double>(), 0) << key;
  for (const char* key : {"seconds", "photons_per_second", "rays_per_photon", "photons_per_texel", "threads"})
    EXPECT_GT(c["time"][key].get<double>(), 0) << key;
  EXPECT_EQ(c["time"]["photons"], 20'000'000);
  EXPECT_EQ(c["scene"]["name"], "glossy_room.glb (built in)");
  EXPECT_EQ(c["warnings"], json::array()) << "nothing is wrong with the scene that ships";
}

TEST_F(CheckProgram, FluxOfTheCornellBoxIsThatOfItsLamp) {
  const json lights = check(kQuickScene)["lights"];
  ASSERT_EQ(lights["sources"].size(), 1u);
  constexpr double kPi = 3.14159265358979323846, kArea = 0.130 * 0.105;  // m², Cornell data
  const double radiance[] = {17000, 12000, 4000};                        // cd/m²
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(lights["flux_lm"][c].get<double>(), kPi * kArea * radiance[c], 1e-4 * kPi * kArea * radiance[c]);
  EXPECT_NEAR(lights["luminous_flux_lm"].get<double>(), kPi * kArea * (0.2126 * 17000 + 0.7152 * 12000 + 0.0722 * 4000),
              0.05);
  EXPECT_NEAR(lights["sources"][0]["area_m2"].get<double>(), kArea, 1e-5);
  EXPECT_EQ(lights["sources"][0]["share"], 1.0);
}

TEST_F(CheckProgram, EstimatesAreThoseOfTheBakeWithTheSameOptions) {
  const std::string options = std::string(kQuickScene) + "--photons 50k --density 24 --directions 6 ";
  const json c = check(options);
  mustRun("bake -o box.dlm --quiet --report r.json " + options);
  const json r = json::parse(slurp(folder_ / "r.json"));
  for (const char* key : {"charts", "directions", "texels"}) EXPECT_EQ(c["layout"][key], r[key]) << key;
  EXPECT_EQ(c["resources"]["tally_bytes"], r["tally_bytes"]);
  EXPECT_GE(c["resources"]["map_bytes"], r["map_bytes"]);
  std::uintmax_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder_ / "box.dlm")) bytes += file.file_size();
  EXPECT_GE(c["resources"]["dlm_bytes"].get<std::uintmax_t>(), bytes);
  // Stored hits a photon, five standard errors of a few hundred photons.
  const double perTexel = r["stored_hits"].get<double>() / c["layout"]["covered_texels"].get<double>();
  EXPECT_NEAR(c["time"]["photons_per_texel"].get<double>() / perTexel, 1, 0.4);
}

TEST_F(CheckProgram, ABlackSceneIsWarnedOf) {
  write("dark.gltf", triangle(R"(,"materials":[{"name":"grey"}])"));
  const json c = check("dark.gltf");
  EXPECT_TRUE(warned(c, "no_light")) << c["warnings"];
  EXPECT_FALSE(c["time"].contains("seconds"));
  const ProgramOutcome text = run("check dark.gltf");
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("the bake will be black"), std::string::npos) << text.out;
  EXPECT_EQ(text.err, "");
}

TEST_F(CheckProgram, WhatIsNotModelledIsListed) {
  write("sheen.gltf", triangle(R"(,"materials":[{"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_sheen":{}}}],
"extensionsUsed":["KHR_materials_sheen","XYZ_unheard_of"],"animations":[{"channels":[{"sampler":0,"target":{"path":"weights"}}],
"samplers":[{"input":0,"output":0}]}])"));
  const ProgramOutcome o = run("check --json sheen.gltf");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string listed = json::parse(o.out)["left_out"].dump();
  EXPECT_NE(listed.find("sheen"), std::string::npos) << listed;
  EXPECT_NE(listed.find("XYZ_unheard_of"), std::string::npos) << listed;
}

TEST_F(CheckProgram, BadFilesAndWrongUsageEndInOneLine) {
  write("cut.glb", slurp(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb").substr(0, 3000));
  const auto refused = [&](const std::string& arguments, int code, const std::string& words) {
    const ProgramOutcome o = run("check " + arguments);
    EXPECT_EQ(o.code, code) << arguments;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    EXPECT_NE(o.err.find(words), std::string::npos) << o.err;
    EXPECT_EQ(o.out, "") << arguments;
  };
  refused("cut.glb", 3, "cut.glb");
  write("syntax.gltf", "{\"asset\": ]}");
  refused("syntax.gltf", 3, "syntax.gltf: its JSON cannot be read: parse error at line 1");
  refused("nothere.glb --json", 3, "nothere.glb");
  refused("--directions 0", 2, "--directions");
  refused("--photons -3", 2, "--photons");
  refused("--threads 5000", 2, "--threads");
  refused("--format ldr", 2, "half");
  refused("-o x.dlm", 2, "-o");
}

TEST_F(CheckProgram, ABakeThatWouldFailEndsWithThreeAndSaysWhy) {
  // Tallies of 63 bits end at some 10^11 photons, which a bake would find out after weeks.
  const ProgramOutcome full = run(std::string("check") + kQuickScene + "--photons 1e13 --plan plan.json");
  EXPECT_EQ(full.code, 3);
  EXPECT_NE(full.out.find("would fail"), std::string::npos) << "all is told nevertheless";
  EXPECT_NE(full.err.find("the tallies would be full after"), std::string::npos) << full.err;
  EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1);
  EXPECT_FALSE(exists("plan.json")) << "a plan that no bake can follow";
  const ProgramOutcome charts = run(std::string("check") + kQuickScene + "--texels 1");
  EXPECT_EQ(charts.code, 3);
  EXPECT_NE(charts.err.find("the bake would fail: "), std::string::npos) << charts.err;
}

TEST_F(CheckProgram, LargeTalliesAreNotTouchedForASample) {
  const json small = check(kQuickScene);
  EXPECT_EQ(small["time"]["sampled_tally_bytes"], small["resources"]["tally_bytes"]);
  const json large = check(std::string(kQuickScene) + "--directions 64 --density 2000 --texels 1M");
  EXPECT_GT(large["resources"]["tally_bytes"], 500'000'000);
  EXPECT_GT(large["time"]["sampled_tally_bytes"], 0);
  EXPECT_LT(large["time"]["sampled_tally_bytes"], 100'000'000);
}

TEST_F(CheckProgram, WritesNothing) {
  mustRun("check");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2) << "more than stdout and stderr";
}

}  // namespace
}  // namespace lucarne::test::check_test
