#include "player/truth_view.h"

#include <gtest/gtest.h>

#include <chrono>

#include "player/camera_choice.h"
#include "tests/support/scene_builder.h"

namespace lucarne::truth_view_test {
namespace {

/// Waits, for as long as it takes, for a picture of at least so many paths.
TruthView::Progress waitFor(TruthView& truth, std::uint32_t samples) {
  while (true) {
    if (auto news = truth.take(); news && news->samples >= samples) return *std::move(news);
    if (!truth.failure().empty()) throw std::runtime_error(truth.failure());
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Red before the eye at the origin, blue behind it.
Scene twoWalls() {
  test::SceneBuilder b;
  const auto red = b.addDiffuse(Rgb(0.f), {2.f, 0.f, 0.f}), blue = b.addDiffuse(Rgb(0.f), {0.f, 0.f, 3.f});
  b.addQuad({-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1}, red);
  b.addQuad({9, -9, 1}, {-9, -9, 1}, {-9, 9, 1}, {9, 9, 1}, blue);
  return b.build();
}

Camera fromOrigin(const Scene& scene, double z) {
  return lookAt(scene.frame.toLocal({0, 0, 0}), scene.frame.toLocal({0, 0, z}), 0.8);
}

TEST(TruthView, ShowsWhatTheCameraSeesCoarseFirst) {
  const Scene scene = twoWalls();
  TruthView truth(scene, {});
  EXPECT_FALSE(truth.take());
  truth.look(fromOrigin(scene, -1), 19, 11);
  const TruthView::Progress first = waitFor(truth, 0), later = waitFor(truth, 3);
  for (const auto& p : {first, later}) {
    ASSERT_EQ(p.image.width, 19);
    ASSERT_EQ(p.image.height, 11);
    for (const Rgb& pixel : p.image.pixels) EXPECT_EQ(pixel, (Rgb{2.f, 0.f, 0.f}));
  }
}

TEST(TruthView, AnotherCameraStartsAnewAndOldPicturesNeverCome) {
  const Scene scene = twoWalls();
  TruthView truth(scene, {});
  for (int i = 0; i < 20; ++i) {
    const bool ahead = i % 2 == 0;
    truth.look(fromOrigin(scene, ahead ? -1 : 1), 16, 16);
    if (i % 5 == 4) continue;  // overtaken before anything is there
    const auto seen = waitFor(truth, 1).image.pixels.at(100);
    EXPECT_EQ(seen, ahead ? (Rgb{2.f, 0.f, 0.f}) : (Rgb{0.f, 0.f, 3.f}));
  }
}

TEST(TruthView, TheSameCameraGoesOn) {
  const Scene scene = twoWalls();
  TruthView truth(scene, {});
  const Camera camera = fromOrigin(scene, -1);
  std::uint32_t last = 0;
  for (int i = 0; i < 5; ++i) {
    truth.look(camera, 8, 8);
    const std::uint32_t now = waitFor(truth, last + 1).samples;
    EXPECT_GT(now, last);
    last = now;
  }
}

TEST(TruthView, RestsAndEndsInTheMiddleOfWork) {
  const Scene scene = twoWalls();
  {
    TruthView truth(scene, {});
    truth.look(fromOrigin(scene, -1), 4000, 4000);
    truth.rest();
    EXPECT_FALSE(truth.take());
    truth.look(fromOrigin(scene, 1), 4000, 4000);
  }
  { const TruthView unused(scene, {}); }
}

TEST(TruthView, TheSkyShines) {
  test::SceneBuilder b;
  b.addQuad({50, 50, 50}, {51, 50, 50}, {51, 51, 50}, {50, 51, 50}, b.addDiffuse(Rgb(0.5f)));
  const Scene scene = b.build();
  TruthView truth(scene, ImageRgb{4, 2, std::vector<Rgb>(8, Rgb{1.f, 2.f, 3.f})});
  truth.look(lookAt(scene.frame.toLocal({0, 0, 0}), scene.frame.toLocal({0, 0, -1}), 0.8), 8, 8);
  EXPECT_EQ(waitFor(truth, 1).image.pixels.at(20), (Rgb{1.f, 2.f, 3.f}));
}

}  // namespace
}  // namespace lucarne::truth_view_test
