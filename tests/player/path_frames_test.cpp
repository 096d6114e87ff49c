// Pictures of a recorded walk.
#include "player/path_frames.h"

#include <map>

#include "tests/player/gl_available.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::path_frames_test {
namespace {

using test::BakedScene;

class PathFramesDrawn : public test::GlTest {
 protected:
  PathFramesDrawn() : baked_(test::furnishedRoom(14)) {
    const Camera& camera = baked_.scene.cameras.at(0);
    path_.rate = 2;
    path_.yfov = 50;
    WalkPose pose = poseOf(camera, baked_.scene.frame);
    for (int i = 0; i < 6; ++i, pose.yaw += 25) path_.poses.push_back(pose);
    options_.render.width = 96;
    options_.render.height = 54;
    options_.fps = 8;
  }

  using Pictures = std::map<std::size_t, std::vector<std::uint8_t>>;
  Pictures draw(const std::function<bool(std::size_t)>& isWanted, Benchmark* benchmark = nullptr) const {
    Pictures pictures;
    const Benchmark b = drawPath(baked_.scene, baked_.maps, path_, options_,
                                 {isWanted, [&](std::size_t i, const auto& rgb) { pictures[i] = rgb; }});
    if (benchmark != nullptr) *benchmark = b;
    return pictures;
  }

  BakedScene baked_;
  WalkPath path_;
  PathFramesOptions options_;
};

TEST_F(PathFramesDrawn, EveryFrameIsDrawnAndTheViewMoves) {
  Benchmark benchmark;
  const Pictures pictures = draw([](std::size_t) { return true; }, &benchmark);
  ASSERT_EQ(pictures.size(), 21u);
  for (const auto& [i, rgb] : pictures) ASSERT_EQ(rgb.size(), 96u * 54 * 3);
  EXPECT_NE(pictures.at(0), pictures.at(20));
  EXPECT_NE(pictures.at(0), pictures.at(1)) << "between two poses of the path";
  EXPECT_EQ(benchmark.frameSeconds.size(), 20u);
  EXPECT_GT(benchmark.glBytes, benchmark.stats.lightMapBytes);
}

TEST_F(PathFramesDrawn, AFrameIsTheSameWhicheverBeforeItAreWanted) {
  const Pictures all = draw([](std::size_t) { return true; });
  const Pictures some = draw([](std::size_t i) { return i == 3 || i == 7 || i == 19 || i == 20; });
  ASSERT_EQ(some.size(), 4u);
  for (const auto& [i, rgb] : some) EXPECT_EQ(rgb, all.at(i)) << i;
}

TEST_F(PathFramesDrawn, TheOverlayIsInThePicture) {
  const Pictures plain = draw([](std::size_t i) { return i == 0; });
  options_.overlay = true;
  const Pictures with = draw([](std::size_t i) { return i == 0; });
  EXPECT_NE(plain.at(0), with.at(0));
}

}  // namespace
}  // namespace lucarne::path_frames_test
