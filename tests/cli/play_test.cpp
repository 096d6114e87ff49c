// play, in a real window: keys, mouse, size, its end, maps that change; and where there is no window to be had.
#include "tests/cli/display.h"

namespace lucarne::play_test {
namespace {

namespace fs = std::filesystem;
using test::soon;

class Play : public test::DisplayTest {
 protected:
  static constexpr Part kRight{320, 10, 150, 220};  // of a window of 480 × 240 at the corner of the display

  void bake(const std::string& options = "") {
    mustRun("bake '" LUCARNE_SOURCE_DIR "/scenes/glossy_room.glb' -o room.dlm --density 3 --photons 30k --quiet " +
            options);
  }
  void open(const std::string& options = "") {
    start("play room.dlm --size 480x240 " + options);
    ASSERT_TRUE(findWindow("Lucarne: room.dlm")) << log();
    tool("windowmove WINDOW 0 0");
    focus();
    ASSERT_TRUE(soon([&] { return isLit(part()) && settled(); })) << log();
  }
  /// Keys go to the window once it is on the display.
  void focus() {
    ASSERT_TRUE(soon([&] { return tries("windowfocus --sync WINDOW"); }));
  }
  std::string log() const { return test::slurp(folder_ / "log"); }
  std::vector<std::uint32_t> part() const { return screen(kRight); }
  static bool isLit(const std::vector<std::uint32_t>& pixels) {
    return std::count(pixels.begin(), pixels.end(), 0u) < static_cast<std::ptrdiff_t>(pixels.size() / 2);
  }
  /// The picture has come to rest.
  bool settled() const {
    const auto before = part();
    for (int i = 0; i < 6; ++i) {
      ::usleep(200'000);
      if (before != part()) return false;
    }
    return true;
  }
  bool changesFrom(const std::vector<std::uint32_t>& before, double share = 0.05) {
    return soon([&] { return difference(before, part()) > share || !program_->running(); }) && program_->running();
  }
  int quit() {
    tool("key Escape");
    return soon([&] { return !program_->running(); }) ? program_->exitCode() : -1;
  }
  nlohmann::json json(const char* name) const { return nlohmann::json::parse(test::slurp(folder_ / name)); }
};

TEST_F(Play, WalksLooksAndKeepsARecord) {
  bake();
  open("--record walk.json --screenshot last.png");
  const auto first = part();
  tool("keydown w");
  EXPECT_TRUE(changesFrom(first)) << log();
  tool("keyup w");
  ASSERT_TRUE(soon([&] { return settled(); }));
  const auto walked = part();
  tool("mousemove --window WINDOW 300 200 click 1");
  EXPECT_TRUE(soon([&] { return tries("mousemove_relative 30 0") && difference(walked, part()) > 0.05; })) << log();
  tool("key Escape");  // lets the mouse go
  ASSERT_TRUE(soon([&] { return settled(); }));
  const auto looked = part();
  tool("key 2");  // multipass draws the same picture
  ASSERT_TRUE(soon([&] { return settled(); }));
  EXPECT_LT(difference(looked, part()), 0.02);
  tool("key equal key equal");
  EXPECT_TRUE(changesFrom(looked)) << "brighter";
  EXPECT_EQ(quit(), 0) << log();
  const auto walk = json("walk.json");
  const auto a = walk["poses"].front(), b = walk["poses"].back();
  EXPECT_GT(std::hypot(a[0].get<double>() - b[0].get<double>(), a[2].get<double>() - b[2].get<double>()), 0.05);
  EXPECT_LT(b[3].get<double>(), a[3].get<double>() - 3) << "turned to the right";
  EXPECT_TRUE(exists("last.png"));
}

TEST_F(Play, KeepsTheRecordWhenASignalEndsIt) {
  bake();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove(folder_ / "walk.json");
    open("--record walk.json");
    const auto first = part();
    tool("keydown w");
    EXPECT_TRUE(changesFrom(first)) << log();
    ::kill(program_->pid(), signal);
    ASSERT_TRUE(soon([&] { return !program_->running(); })) << log();
    tool("keyup w");
    EXPECT_EQ(program_->exitCode(), 130) << log();
    EXPECT_GT(json("walk.json")["poses"].size(), 10u) << log();
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_EQ(entry.path().filename().string().find("walk.json."), std::string::npos) << "nothing is left aside";
  }
}

TEST_F(Play, KeepsTheRecordWhenAnotherFileCannotBeWritten) {
  bake();
  fs::create_directory(folder_ / "pictures");
  open("--record again.json --screenshot pictures/last.png");
  fs::remove(folder_ / "pictures");
  EXPECT_EQ(quit(), 1) << log();
  EXPECT_GT(json("again.json")["poses"].size(), 10u) << log();
}

TEST_F(Play, EndsAtASignalWhileItLoads) {
  bake();
  start("play room.dlm --size 480x240 --record walk.json");
  ASSERT_TRUE(findWindow("Lucarne: room.dlm")) << log();
  ::kill(program_->pid(), SIGTERM);
  ASSERT_TRUE(soon([&] { return !program_->running(); })) << log();
  EXPECT_EQ(program_->exitCode(), 130) << log();
}

TEST_F(Play, TakesAnySizeAndBeingHidden) {
  bake();
  open();
  tool("windowsize WINDOW 421 377");
  EXPECT_TRUE(soon([&] { return isLit(screen({320, 20, 90, 340})) && !isLit(screen({430, 20, 50, 220})); })) << log();
  tool("windowunmap WINDOW");
  EXPECT_TRUE(soon([&] { return !isLit(screen({320, 20, 90, 340})); }));
  tool("windowmap WINDOW");
  tool("windowsize WINDOW 1 1");
  tool("windowsize WINDOW 480 240");
  focus();
  EXPECT_TRUE(soon([&] { return isLit(part()); })) << log();
  EXPECT_EQ(quit(), 0) << log();
}

TEST_F(Play, TakesAnySizeWhileItLoads) {
  bake();
  start("play room.dlm --size 480x240");
  ASSERT_TRUE(findWindow("Lucarne: room.dlm")) << log();
  for (const char* step : {"windowsize WINDOW 1 1", "windowunmap WINDOW", "windowmap WINDOW", "windowsize WINDOW 800 600",
                           "windowsize WINDOW 480 240", "windowmove WINDOW 0 0"})
    tool(step);
  EXPECT_TRUE(soon([&] { return isLit(part()); })) << log();
  focus();
  EXPECT_EQ(quit(), 0) << log();
}

TEST_F(Play, KeepsThePictureWhenAFileOfTheReplacedMapsIsCutShort) {
  bake();
  open("--watch");
  const auto first = part();
  for (const char* file : {"directional.exr", "irradiance.exr", "scene.glb"}) {
    fs::copy(folder_ / "room.dlm", folder_ / "cut.dlm");
    const fs::path cut = folder_ / "cut.dlm" / file;
    fs::resize_file(cut, fs::file_size(cut) / 2);
    fs::remove_all(folder_ / "room.dlm");
    fs::rename(folder_ / "cut.dlm", folder_ / "room.dlm");
    EXPECT_TRUE(soon([&] { return log().find(std::string(file)) != std::string::npos; })) << log();
    EXPECT_LT(difference(first, part()), 0.05) << file;
    fs::remove_all(folder_ / "room.dlm");
    bake();
    ASSERT_TRUE(soon([&] { return settled(); }));
  }
  const std::string told = log();
  int lines = 0;
  for (std::size_t at = told.find("lucarne: "); at != std::string::npos; at = told.find("lucarne: ", at + 1)) ++lines;
  EXPECT_EQ(lines, 3) << "one line each\n" << told;
  EXPECT_EQ(quit(), 0) << log();
}

TEST_F(Play, ShowsMapsThatAreReplacedAndKeepsThoseThatAreSpoiled) {
  bake();
  open("--watch");
  const auto first = part();
  bake("--light direct");
  EXPECT_TRUE(changesFrom(first)) << log();
  ASSERT_TRUE(soon([&] { return settled(); }));
  const auto second = part();
  std::ofstream(folder_ / "room.dlm" / "manifest.json") << "{";
  EXPECT_TRUE(soon([&] { return log().find("not reloaded: ") != std::string::npos; })) << log();
  ASSERT_TRUE(soon([&] { return settled(); }));
  EXPECT_LT(difference(second, part()), 0.02);
  fs::remove_all(folder_ / "room.dlm");
  bake();
  EXPECT_TRUE(changesFrom(second)) << log();
  ASSERT_TRUE(soon([&] { return settled(); }));
  const auto third = part();
  tool("key r");
  ASSERT_TRUE(soon([&] { return settled(); }));
  EXPECT_LT(difference(third, part()), 0.02);
  EXPECT_EQ(quit(), 0) << log();
}

TEST_F(Play, ReplaysAsRenderDoesAndTellsItsTimes) {
  bake();
  std::ofstream(folder_ / "walk.json") << R"({"format": "lucarne-walk", "version": 1, "rate": 10, "yfov": 50, "poses": [
    [2.62, 1.6, 1.92, 46, -11], [2.62, 1.6, 1.92, 46, -11], [2.62, 1.6, 1.92, 46, -11], [2.62, 1.6, 1.92, 46, -11], [2.62, 1.6, 1.92, 46, -11]]})";
  start("play room.dlm --size 400x240 --replay walk.json --benchmark times.json --fps 20 --screenshot last.png");
  ASSERT_TRUE(soon([&] { return !program_->running(); }));
  ASSERT_EQ(program_->exitCode(), 0) << log();
  const auto times = json("times.json");
  EXPECT_EQ(times["frames"], 8) << "nine, the first not counted";
  EXPECT_GT(times["frame_ms"]["p50"], 0);
  EXPECT_GE(times["frame_ms"]["max"], times["frame_ms"]["p99"]);
  EXPECT_EQ(times["width"], 400);
  mustRun("render room.dlm --size 400x240 --replay walk.json --fps 20 -o frames --quiet");
  const auto read = [&](const char* name) {
    const std::string bytes = test::slurp(folder_ / name);
    return decodeImage({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, name);
  };
  const DecodedImage window = read("last.png"), frame = read("frames/frame_00008.png");
  ASSERT_EQ(window.rgba.size(), frame.rgba.size());
  int largest = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 352; x < 400; ++x) {
      const auto i = static_cast<std::size_t>(4 * (y * 400 + x));
      for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(window.rgba[i + c] - frame.rgba[i + c]));
    }
  }
  EXPECT_LE(largest, 1);
}

TEST_F(Play, WithoutOpenGl45SaysSo) {
  bake();
  const auto o = shell("DISPLAY=" + display_ + " MESA_GL_VERSION_OVERRIDE=3.3 \"$LUCARNE\" play room.dlm --frames 1");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("OpenGL 4.5"), std::string::npos) << o.err;
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
}

class PlayNowhere : public test::ProgramTest {};

TEST_F(PlayNowhere, WithoutADisplayItPointsToRender) {
  mustRun("bake '" LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb' -o room.dlm --density 4 --photons 1k --quiet");
  for (const char* display : {"env -u DISPLAY", "DISPLAY=", "DISPLAY=:98765"}) {
    const auto o = shell(std::string(display) + " \"$LUCARNE\" play room.dlm");
    EXPECT_EQ(o.code, 1) << o.err;
    EXPECT_NE(o.err.find("lucarne render"), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  }
  const auto o = shell("env -u DISPLAY \"$LUCARNE\" play nowhere.dlm");
  EXPECT_EQ(o.code, 3) << o.err;
}

}  // namespace
}  // namespace lucarne::play_test
