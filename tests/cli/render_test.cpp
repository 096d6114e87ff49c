// render: its options, each with what it changes, and hostile values of those that play shares.
#include <cmath>

#include "base/image_file.h"
#include "tests/cli/driver_leaks.h"
#include "tests/cli/program.h"

namespace lucarne::render_test {
namespace {

namespace fs = std::filesystem;

class Render : public test::ProgramTest {
 protected:
  test::DriverLeaksAllowed driverLeaks_;

  void SetUp() override {
    ProgramTest::SetUp();
    mustRun("bake" + std::string(test::kQuickScene) + "-o room.dlm --density 4 --photons 20k --quiet");
    const auto o = run("render room.dlm --size 8x8 -o probe.png");
    if (o.err.find("no OpenGL") != std::string::npos) GTEST_SKIP() << o.err;
    ASSERT_EQ(o.code, 0) << o.err;
  }
  DecodedImage png(const std::string& options, const std::string& size = "64x48") {
    mustRun("render room.dlm --size " + size + " -o picture.png --quiet " + options);
    const std::string bytes = test::slurp(folder_ / "picture.png");
    return decodeImage({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "picture.png");
  }
  ImageRgb exr(const std::string& options) {
    mustRun("render room.dlm --size 64x48 -o picture.exr --quiet " + options);
    return readExrRgb(folder_ / "picture.exr");
  }
  static double mean(const DecodedImage& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.rgba.size(); ++i) sum += i % 4 == 3 ? 0 : image.rgba[i];
    return sum / static_cast<double>(image.rgba.size() * 3 / 4);
  }
  static Rgbd mean(const ImageRgb& image) {
    Rgbd sum{};
    for (const Rgb& p : image.pixels) sum = sum + Rgbd(p);
    return sum / static_cast<double>(image.pixels.size());
  }
  /// One line that holds `words`, that code, and no picture.
  void expectRefusal(const std::string& arguments, int code, const std::string& words) const {
    const auto o = run(arguments);
    EXPECT_EQ(o.code, code) << arguments << "\n" << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << arguments << "\n" << o.err;
    EXPECT_NE(o.err.find(words), std::string::npos) << arguments << "\n" << o.err;
    EXPECT_FALSE(exists("x.png") || exists("x.exr")) << arguments;
  }
};

TEST_F(Render, ExposureAndToneCurveAreThoseAskedFor) {
  const double dark = mean(png("--exposure 12")), light = mean(png("--exposure 4"));
  EXPECT_LT(dark, light / 2);
  EXPECT_LT(mean(png("--exposure 12")), 255);
  EXPECT_NE(png("--exposure 6 --tonemap plain").rgba, png("--exposure 6 --tonemap filmic").rgba);
  EXPECT_EQ(png("--exposure auto").rgba, png("").rgba);
  EXPECT_EQ(mean(exr("--exposure 12")), mean(exr(""))) << "an .exr has no exposure";
}

TEST_F(Render, EveryViewHasAPictureOfItsOwn) {
  std::vector<std::vector<std::uint8_t>> seen;
  for (const char* view : {"full", "irradiance", "direction --psi 3", "photons", "error", "density", "texels", "charts", "wireframe",
                           "albedo", "normals"}) {
    const auto picture = png("--view " + std::string(view)).rgba;
    for (const auto& other : seen) EXPECT_NE(picture, other) << view;
    seen.push_back(picture);
  }
  Rgbd all{};
  for (int psi = 0; psi < 14; ++psi) all = all + mean(exr("--map-format float --view direction --psi " + std::to_string(psi)));
  const Rgbd whole = mean(exr("--map-format float --view irradiance"));
  EXPECT_NEAR(all.x, whole.x, 2e-3 * whole.x) << "all directions together are the irradiance";
}

TEST_F(Render, FormatsAndLobesShowTheSameRoom) {
  const Rgbd exact = mean(exr("--map-format float"));
  EXPECT_NEAR(mean(exr("--map-format half")).x, exact.x, 1e-3 * exact.x);
  EXPECT_NEAR(mean(exr("--map-format rgb9e5")).x, exact.x, 5e-3 * exact.x);
  EXPECT_NEAR(mean(exr("--renderer multipass --map-format float")).x, exact.x, 1e-3 * exact.x);
  const double albedo = mean(exr("--view albedo")).x;
  EXPECT_NEAR(mean(exr("--view albedo --supersample 2")).x, albedo, 0.05 * albedo);
}

TEST_F(Render, LittleGpuMemoryIsToldAndTooLittleIsRefused) {
  const auto o = run("render room.dlm --size 64x48 -o small.exr --gpu-memory 3k");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("of GPU memory"), std::string::npos) << o.err;
  const Rgbd whole = mean(exr("--view irradiance")), small = mean(exr("--view irradiance --gpu-memory 3k"));
  EXPECT_NEAR(small.y, whole.y, 1e-3 * whole.y) << "the irradiance stays";
  expectRefusal("render room.dlm -o x.exr --gpu-memory 1k", 5, "GPU memory");
}

TEST_F(Render, TheOverlayLiesOverASinglePictureAndNothingElseChanges) {
  const DecodedImage plain = png("", "480x300"), told = png("--overlay", "480x300");
  ASSERT_EQ(plain.rgba.size(), told.rgba.size());
  std::size_t left = 0, right = 0;
  for (std::size_t i = 0; i < plain.rgba.size(); ++i)
    if (plain.rgba[i] != told.rgba[i]) ++(i / 4 % 480 < 400 ? left : right);
  EXPECT_GT(left, plain.rgba.size() / 20);
  EXPECT_EQ(right, 0u);
  expectRefusal("render room.dlm -o x.exr --overlay", 2, ".png");
  expectRefusal("render room.dlm -o x.png --overlay --renderer pathtraced", 2, "--overlay");
}

TEST_F(Render, WrongValuesAreRefusedInOneLine) {
  const std::string render = "render room.dlm -o x.png ";
  for (const char* wrong : {"--view light", "--psi -1", "--psi 14 --view direction", "--psi 1e9", "--psi 99999",
                            "--tonemap bright", "--exposure dark", "--exposure nan", "--exposure inf", "--exposure 1e9",
                            "--gpu-memory -1", "--gpu-memory much", "--gpu-memory 1e400", "--size 0x4", "--size 4",
                            "--size 4x4x4", "--size 99999x99999", "--supersample 0", "--supersample 17", "--lobe sharp",
                            "--map-format bc6h", "--renderer fast", "--camera nobody", "--camera 99", "--fps 0", "--benchmark t.json"})
    expectRefusal(render + wrong, 2, std::string(wrong).substr(0, std::string(wrong).find(' ')));
  expectRefusal("render room.dlm -o x.jpg", 2, "x.jpg");
  expectRefusal("render nothing.dlm -o x.png", 3, "nothing.dlm");
  expectRefusal("render room.dlm -o missing/x.png", 1, "missing");
  expectRefusal("render room.dlm -o x.png --environment nosky.hdr", 3, "nosky.hdr");
}

TEST_F(Render, ShortAndSpoiledFilesOfLightMapsAreNamed) {
  for (const char* file : {"manifest.json", "scene.glb", "irradiance.exr", "directional.exr"}) {
    for (const bool cut : {true, false}) {
      fs::remove_all(folder_ / "bad.dlm");
      fs::copy(folder_ / "room.dlm", folder_ / "bad.dlm");
      const fs::path path = folder_ / "bad.dlm" / file;
      if (cut) {
        fs::resize_file(path, fs::file_size(path) / 2);
      } else {
        std::ofstream(path) << "garbage";
      }
      expectRefusal("render bad.dlm -o x.png", 3, file);
      fs::remove(path);
      expectRefusal("render bad.dlm -o x.png", 3, file);
    }
  }
}

TEST_F(Render, PlayRefusesWrongValuesBeforeItLooksForADisplay) {
  const std::string play = "play room.dlm ";
  for (const char* wrong : {"--view light", "--psi -1", "--tonemap bright", "--gpu-memory much", "--size 0x4", "--scale 0", "--scale 2",
                            "--scale nan", "--lobe sharp", "--renderer pathtraced", "--frames -1", "--fps 0",
                            "--benchmark t.json"})
    expectRefusal(play + wrong, 2, std::string(wrong).substr(0, std::string(wrong).find(' ')));
  expectRefusal(play + "--record a.json --replay b.json", 2, "--re");
  expectRefusal(play + "--replay nowhere.json", 3, "nowhere.json");
  expectRefusal(play + "--record missing/walk.json", 1, "missing");
}

}  // namespace
}  // namespace lucarne::render_test
