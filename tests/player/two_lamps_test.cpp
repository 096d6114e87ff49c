// The scene with a red and a blue lamp over a glossy floor, from the file to the picture.
#include <array>
#include <nlohmann/json.hpp>

#include "app/bake.h"
#include "base/log.h"
#include "dlm/dlm_reader.h"
#include "player/camera_choice.h"
#include "player/offscreen.h"
#include "tests/base/temp_folder.h"
#include "tests/player/gl_available.h"

namespace lucarne::two_lamps_test {
namespace {

class TwoLamps : public test::GlTest {
 protected:
  static constexpr int kWidth = 320, kHeight = 180;

  void SetUp() override {
    test::GlTest::SetUp();
    if (IsSkipped()) return;
    BakeOptions o;
    o.scene = LUCARNE_SOURCE_DIR "/scenes/two_lamps.glb";
    o.output = folder_ / "lamps.dlm";
    o.photons = 2'000'000;
    o.directions = 64;
    o.texelsPerMetre = 10;
    setQuiet(true);
    bake(o);
    dlm_ = readDlm(o.output);
    camera_ = chooseCamera(dlm_.scene, "front");
    image_ =
        renderImage(dlm_.scene, dlm_.maps, camera_, {kWidth, kHeight, RendererKind::singlepass, LightMapFormat::half});
  }

  /// What the picture shows of a point of the floor, averaged over nine pixels.
  Rgb floorAt(double x, double z) const {
    const Vec3d e = dlm_.scene.frame.toLocal({x, 0, z}) - camera_.position;
    const double scale = kHeight / (2 * std::tan(camera_.yfov / 2)) / -dot(e, camera_.back);
    const int column = static_cast<int>(kWidth / 2.0 + dot(e, camera_.right) * scale);
    const int row = static_cast<int>(kHeight / 2.0 - dot(e, camera_.up) * scale);
    Rgb sum{};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx)
        sum += image_.pixels.at(static_cast<std::size_t>((row + dy) * kWidth + column + dx));
    }
    return sum / 9.f;
  }

  struct Peak {
    double x = 0, z = 0;
    Rgb light{};
  };
  /// The brightest place of the floor before the lamps, on the side of x's sign.
  Peak peak(double sign) const {
    Peak best;
    for (double z = -0.75; z < 0.95; z += 0.05) {
      for (double x = 0.1; x < 1.5; x += 0.05) {
        const Rgb light = floorAt(sign * x, z);
        if (luminance(light) > luminance(best.light)) best = {sign * x, z, light};
      }
    }
    return best;
  }

  TempFolder folder_;
  Dlm dlm_;
  Camera camera_;
  ImageRgb image_;
};

TEST_F(TwoLamps, EachHasItsOwnHighlightInItsOwnColour) {
  // A mirror would show the lamps, 0.75 m high at x = ±1.1, z = −1, where the ray from the eye, 1.45 m high at z = 2.4,
  // to their mirror images goes through the floor.
  const double along = 1.45 / (1.45 + 0.75), mirrorX = 1.1 * along, mirrorZ = 2.4 - 3.4 * along;
  const Peak red = peak(-1), blue = peak(1);
  EXPECT_GT(red.light.x, 3 * red.light.z);
  EXPECT_GT(blue.light.z, 3 * blue.light.x);
  for (const Peak& p : {red, blue}) {
    EXPECT_NEAR(std::abs(p.x), mirrorX, 0.5);
    EXPECT_NEAR(p.z, mirrorZ, 0.7);
  }
  // Two peaks with a valley between them, and darker before and behind.
  const float valley = luminance(floorAt(0, 0.5 * (red.z + blue.z)));
  EXPECT_LT(valley, 0.7f * luminance(red.light));
  EXPECT_LT(valley, 0.7f * luminance(blue.light));
  EXPECT_LT(luminance(floorAt(0, 0.95)), 0.5f * luminance(red.light));
}

}  // namespace
}  // namespace lucarne::two_lamps_test
