// What light does not touch is changed without tracing again.
#include "tests/cli/program.h"
#include "tests/support/changed_scene.h"

namespace lucarne::test::rebake_test {
namespace {

using nlohmann::json;

class Rebake : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    writeChangedCornellBox(folder_ / "box.glb", [](Json&) {});
    writeChangedCornellBox(folder_ / "view.glb", [](Json& j) { changeWhatLightDoesNotTouch(j); });
    writeChangedCornellBox(folder_ / "red.glb",
                           [](Json& j) { j["materials"][3]["pbrMetallicRoughness"]["baseColorFactor"][0] = 0.5; });
  }
  std::vector<std::string> camerasOf(const std::string& dlm) const {
    std::vector<std::string> names;
    const json scene = json::parse(run("info " + dlm + "/scene.glb --json").out);
    for (const json& c : scene["cameras"]) names.push_back(c["name"]);
    return names;
  }
};

constexpr const char* kSmall = " --photons 40k --density 8 ";

TEST_F(Rebake, OtherCamerasTakeTheKeptPartAndComeIntoTheLightMaps) {
  mustRun(std::string("bake box.glb -o room.dlm --keep-part --quiet") + kSmall);
  const std::string hash = contentHash("room.dlm");
  ASSERT_EQ(camerasOf("room.dlm"), std::vector<std::string>{"published"});
  const auto o = run(std::string("bake view.glb -o room.dlm --keep-part") + kSmall);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("nothing is traced"), std::string::npos) << o.err;
  EXPECT_EQ(camerasOf("room.dlm").size(), 2u);
  EXPECT_EQ(contentHash("room.dlm"), hash);
  // As if it had been traced.
  mustRun(std::string("bake view.glb -o traced.dlm --quiet") + kSmall);
  EXPECT_TRUE(same("room.dlm", "traced.dlm"));
  // The part has the new cameras, too.
  mustRun("merge room.part -o again.dlm --quiet");
  EXPECT_TRUE(same("again.dlm", "traced.dlm"));
}

TEST_F(Rebake, AnotherKernelOrFormatTakesTheKeptPart) {
  mustRun(std::string("bake box.glb -o room.dlm --keep-part --quiet") + kSmall);
  const std::string other = " --kernel box --kernel-width 2 --format float --seams keep ";
  for (const std::string keep : {"--keep-part", "", "--resume"}) {
    const auto o = run("bake box.glb -o room.dlm " + keep + kSmall + other);
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.err.find("photons/s"), std::string::npos) << "no progress of tracing: " << o.err;
    EXPECT_TRUE(exists("room.part"));
  }
  mustRun("bake box.glb -o traced.dlm --quiet" + std::string(kSmall) + other);
  EXPECT_TRUE(same("room.dlm", "traced.dlm"));
}

TEST_F(Rebake, WhatLightTouchesIsTracedAgain) {
  mustRun(std::string("bake box.glb -o room.dlm --keep-part --quiet") + kSmall);
  const std::string before = contentHash("room.part");
  const auto o = run(std::string("bake red.glb -o room.dlm --keep-part") + kSmall);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err.find("nothing is traced"), std::string::npos) << o.err;
  EXPECT_NE(contentHash("room.part"), before);
  // And so are other photons.
  const auto seed = run(std::string("bake red.glb -o room.dlm --seed 4") + kSmall);
  EXPECT_EQ(seed.err.find("nothing is traced"), std::string::npos) << seed.err;
}

TEST_F(Rebake, ADamagedPartIsNamedAndTracedAnew) {
  mustRun(std::string("bake box.glb -o room.dlm --keep-part --quiet") + kSmall);
  const std::string hash = contentHash("room.dlm");
  ASSERT_EQ(
      shell("printf x | dd of=room.part bs=1 seek=$(($(stat -c %s room.part) / 2)) conv=notrunc 2>/dev/null").code, 0);
  const auto o = run(std::string("bake box.glb -o room.dlm") + kSmall);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("tracing instead"), std::string::npos) << o.err;
  EXPECT_EQ(contentHash("room.dlm"), hash);
}

TEST_F(Rebake, ResumeGoesOnWithOtherCamerasAndRefusesOtherLightInWords) {
  mustRun(std::string("bake box.glb -o room.dlm --keep-part --quiet") + kSmall);
  mustRun("bake view.glb -o room.dlm --resume --keep-part --quiet --photons 80k --density 8");
  mustRun("bake view.glb -o traced.dlm --quiet --photons 80k --density 8");
  EXPECT_TRUE(same("room.dlm", "traced.dlm"));
  const auto o = run("bake red.glb -o room.dlm --resume --photons 80k --density 8");
  EXPECT_EQ(o.code, 4);
  EXPECT_NE(o.err.find("the scene (material 'red': base colour (0.63, 0.065, 0.05) → (0.5, 0.065, 0.05))"),
            std::string::npos)
      << o.err;
}

TEST_F(Rebake, FinishedLightMapsOfOtherCamerasAreNotTakenForDone) {
  mustRun(std::string("bake box.glb -o room.dlm --quiet") + kSmall);
  const auto o = run(std::string("bake view.glb -o room.dlm --resume --quiet") + kSmall);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(camerasOf("room.dlm").size(), 2u);
}

TEST_F(Rebake, PartsOfScenesThatDifferInCamerasMergeWithTheCamerasOfTheFirst) {
  mustRun(std::string("bake box.glb -o a.part --part 1/2 --quiet") + kSmall);
  mustRun(std::string("bake view.glb -o b.part --part 2/2 --quiet") + kSmall);
  mustRun("merge a.part b.part -o ab.dlm --quiet");
  mustRun("merge b.part a.part -o ba.dlm --quiet");
  EXPECT_EQ(camerasOf("ab.dlm").size(), 1u);
  EXPECT_EQ(camerasOf("ba.dlm").size(), 2u);
  EXPECT_EQ(contentHash("ab.dlm"), contentHash("ba.dlm"));
}

TEST_F(Rebake, InfoTellsWhetherAPartStillMatchesAndWhatDiffers) {
  mustRun(std::string("bake box.glb -o room.dlm --keep-part --quiet") + kSmall);
  const auto compared = [&](const std::string& path, const std::string& scene) {
    const auto o = run("info " + path + " --scene " + scene + " --json");
    EXPECT_EQ(o.code, 0) << o.err;
    return json::parse(o.out)["compared_with_scene"];
  };
  json c = compared("room.part", "box.glb");
  EXPECT_EQ(c["matches"], true);
  EXPECT_EQ(c["differences"], json::array());
  c = compared("room.part", "view.glb");
  EXPECT_EQ(c["matches"], true);
  EXPECT_EQ(c["same_file"], false);
  EXPECT_EQ(c["differences"].size(), 1u);
  c = compared("room.part", "red.glb");
  EXPECT_EQ(c["matches"], false);
  EXPECT_EQ(c["differences"], json::array({"material 'red': base colour (0.63, 0.065, 0.05) → (0.5, 0.065, 0.05)"}));
  EXPECT_EQ(compared("room.dlm", "view.glb")["matches"], true);
  EXPECT_EQ(compared("room.dlm", "red.glb")["matches"], false);
  EXPECT_EQ(run("info box.glb --scene red.glb").code, 3);
  EXPECT_EQ(run("info room.part --scene nowhere.glb").code, 3);
}

}  // namespace
}  // namespace lucarne::test::rebake_test
