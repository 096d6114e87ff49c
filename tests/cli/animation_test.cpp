// render --replay: pictures of a walk.
#include "tests/cli/driver_leaks.h"
#include "tests/cli/program.h"

namespace lucarne::animation_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWalk = R"({"format": "lucarne-walk", "version": 1, "rate": 1, "yfov": 50, "poses": [
  [0.278, 0.273, -0.8, 180, 0], [0.278, 0.273, -0.5, 195, -5]]})";

class Animation : public test::ProgramTest {
 protected:
  using ProgramOutcome = test::ProgramOutcome;
  test::DriverLeaksAllowed driverLeaks_;

  void SetUp() override {
    ProgramTest::SetUp();
    mustRun("bake '" LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb' -o room.dlm --density 4 --photons 20k --quiet");
    std::ofstream(folder_ / "walk.json") << kWalk;
    const auto o = render("-o probe");
    if (o.err.find("no OpenGL") != std::string::npos) GTEST_SKIP() << o.err;
    ASSERT_EQ(o.code, 0) << o.err;
  }
  ProgramOutcome render(const std::string& options) const {
    const std::string fps = options.find("--fps") == std::string::npos ? "--fps 12 " : "";
    return run("render room.dlm --size 64x48 --replay walk.json " + fps + options);
  }
  int frames(const char* folder) const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / folder))
      count += entry.path().extension() == ".png" ? 1 : 0;
    return count;
  }
  /// A program of that name that tests put before others.
  void fake(const std::string& name, const std::string& script) const {
    fs::create_directories(folder_ / "bin");
    std::ofstream(folder_ / "bin" / name) << "#!/bin/sh\n" << script;
    fs::permissions(folder_ / "bin" / name, fs::perms::owner_all);
  }
};

TEST_F(Animation, HasAPictureForEachFrame) {
  EXPECT_EQ(frames("probe"), 13);
  EXPECT_TRUE(exists("probe/frame_00000.png"));
  EXPECT_TRUE(exists("probe/frame_00012.png"));
  EXPECT_FALSE(same("probe/frame_00000.png", "probe/frame_00012.png"));
}

TEST_F(Animation, IsTakenUpWhereItWasLeft) {
  mustRun("render room.dlm --size 64x48 --replay walk.json --fps 12 -o again --quiet");
  for (const char* frame : {"00003", "00009", "00012"})
    fs::remove(folder_ / "again" / (std::string("frame_") + frame + ".png"));
  fs::remove(folder_ / "again" / "walk.mp4");
  const auto o = render("-o again");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("10 of them from before"), std::string::npos) << o.err;
  fs::remove(folder_ / "again" / "walk.mp4");  // a video holds the time
  fs::remove(folder_ / "probe" / "walk.mp4");
  EXPECT_TRUE(same("probe", "again"));
}

TEST_F(Animation, DoesNotMixWithAnother) {
  for (const char* other : {"--fps 13", "--overlay", "--map-format rgb9e5", "--renderer multipass"}) {
    const auto o = render(std::string("-o probe ") + other);
    EXPECT_EQ(o.code, 2) << other;
    EXPECT_NE(o.err.find("another animation"), std::string::npos) << o.err;
  }
  EXPECT_EQ(frames("probe"), 13);
}

TEST_F(Animation, BecomesAVideoWhereThereIsFfmpeg) {
  fake("ffmpeg", "for last; do :; done\nprintf video > \"$last\"\necho \"$@\" > \"$(dirname \"$0\")/said\"\n");
  const auto o =
      shell("PATH=\"$PWD/bin:$PATH\"; \"$LUCARNE\" render room.dlm --size 64x48 --replay walk.json --fps 12 -o probe");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(test::slurp(folder_ / "probe" / "walk.mp4"), "video");
  EXPECT_NE(test::slurp(folder_ / "bin" / "said").find("-framerate 12 "), std::string::npos);
  fake("ffmpeg", "echo 'no such codec' >&2\nexit 1\n");
  const auto bad =
      shell("PATH=\"$PWD/bin:$PATH\"; \"$LUCARNE\" render room.dlm --size 64x48 --replay walk.json --fps 12 -o probe");
  EXPECT_EQ(bad.code, 1);
  EXPECT_NE(bad.err.find("no such codec"), std::string::npos) << bad.err;
  EXPECT_EQ(test::slurp(folder_ / "probe" / "walk.mp4"), "video") << "the one before stays";
  for (const auto& entry : fs::directory_iterator(folder_ / "probe"))
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path() << " is left behind";
}

TEST_F(Animation, TellsItsTimesWithoutKeepingPictures) {
  const auto o = render("--benchmark times.json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto times = nlohmann::json::parse(test::slurp(folder_ / "times.json"));
  EXPECT_EQ(times["frames"], 12);
  EXPECT_EQ(times["path_fps"], 12);
}

TEST_F(Animation, OptionsThatDoNotGoTogetherAreRefused) {
  EXPECT_EQ(render("").code, 2);
  EXPECT_EQ(render("-o x --renderer pathtraced").code, 2);
  EXPECT_EQ(run("render room.dlm -o x.exr --overlay").code, 2);
  EXPECT_EQ(run("render room.dlm").code, 2);
  std::ofstream(folder_ / "walk.json") << "{}";
  EXPECT_EQ(render("-o x").code, 3);
  EXPECT_FALSE(exists("x"));
}

}  // namespace
}  // namespace lucarne::animation_test
