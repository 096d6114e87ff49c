// A walk does not depend on the frame rate, and is what its record says.
#include "player/walk_driver.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "tests/player/walk_fixture.h"

namespace lucarne::walk_driver_test {
namespace {

test::SceneBuilder hall() {
  test::SceneBuilder b;
  b.addBox({0, 0, 0}, {8, 3, 8}, 0, true);
  for (int i = 0; i < 4; ++i) b.addBox({5, 0, 3}, {7 - 0.3 * i, 0.2 * (i + 1), 5});
  b.addBox({2, 0, 2}, {2.1, 3, 2.1});
  return b;
}

WalkerState startIn(const WalkWorld& world) {
  WalkerState s;
  s.feet = s.safe = Vec3d{3, 0, 6} - world.frame().origin;
  return s;
}

/// Two seconds of walking, running and turning with so many frames a second.
std::vector<WalkPose> walkedAt(const WalkWorld& world, int fps) {
  WalkDriver driver(world, startIn(world));
  driver.record();
  const WalkInput legs[] = {{1, 0, 0, false, false, 0.8, 0},
                            {1, -1, 0, true, false, 0, 0.3},
                            {1, 0, 0, true, false, -1.5, 0},
                            {0, 1, 0, false, true, 0, 0}};
  for (WalkInput leg : legs) {
    for (int i = 0; i < fps / 2; ++i) {
      driver.advance(1.0 / fps, leg, {});
      leg.turnX = leg.turnY = 0;
    }
  }
  return driver.takeRecording();
}

TEST(WalkDriver, GivesTheSameWalkAtAnyFrameRate) {
  const WalkWorld world(hall().build());
  const std::vector<WalkPose> smooth = walkedAt(world, 120);
  ASSERT_EQ(smooth.size(), 241u);
  EXPECT_GT(length(smooth.back().eye - smooth.front().eye), 1);
  for (const int fps : {4, 10, 24, 60, 240, 1000}) {
    const std::vector<WalkPose> other = walkedAt(world, fps);
    ASSERT_NEAR(static_cast<double>(other.size()), 241, 1) << fps;
    if (fps > 120) continue;  // a leg may end a tick later there
    for (std::size_t i = 0; i < std::min(other.size(), smooth.size()); ++i)
      ASSERT_EQ(other[i], smooth[i]) << fps << " " << i;
  }
}

TEST(WalkDriver, BetweenTicksTheEyeIsBetween) {
  const WalkWorld world(hall().build());
  WalkDriver driver(world, startIn(world));
  driver.advance(1.5 / kWalkTicks, test::ahead(), {});
  const double whole = 1.5 / kWalkTicks;  // metres a tick
  const Vec3d eye = world.fromLocal(driver.camera(1).position) + world.frame().origin;
  EXPECT_NEAR(eye.z, 6 - whole / 2, 1e-6);
}

TEST(WalkDriver, AStallDoesNotThrowTheWalkerFar) {
  const WalkWorld world(hall().build());
  WalkDriver driver(world, startIn(world));
  driver.advance(3600, test::ahead(), {});
  EXPECT_NEAR(driver.state().feet.z + world.frame().origin.z, 6 - 0.75, 0.02);
}

class WalkFile : public testing::Test {
 protected:
  WalkFile()
      : path_(std::filesystem::path(testing::TempDir()) /
              ("lucarne_walk_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name() + ".json")) {}
  ~WalkFile() override { std::filesystem::remove(path_); }
  WalkPath readBack(const std::string& text) const {
    std::ofstream(path_) << text;
    return readWalkPath(path_);
  }
  void expectRefused(const std::string& text, const std::string& words) const {
    try {
      readBack(text);
      FAIL() << "taken: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(path_.string()), std::string::npos) << error.what();
    }
  }
  std::filesystem::path path_;
};

TEST_F(WalkFile, KeepsTheWalk) {
  const WalkWorld world(hall().build());
  WalkPath path{120, 50, walkedAt(world, 60)};
  const WalkPath back = readBack(textOf(path));
  ASSERT_EQ(back.poses.size(), path.poses.size());
  EXPECT_EQ(back.rate, 120);
  EXPECT_EQ(back.yfov, 50);
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    EXPECT_LT(length(back.poses[i].eye - path.poses[i].eye), 1e-9);
    EXPECT_NEAR(back.poses[i].yaw, path.poses[i].yaw, 1e-7);
    EXPECT_NEAR(back.poses[i].pitch, path.poses[i].pitch, 1e-7);
  }
}

TEST_F(WalkFile, MayBeWrittenByHand) {
  const WalkPath path = readBack(
      R"({"format": "lucarne-walk", "version": 1, "rate": 0.5, "yfov": 60, "poses": [[0,1.6,0,0,0],[2,1.6,-4,90,-10]]})");
  EXPECT_EQ(path.seconds(), 2);
  EXPECT_EQ(frameCount(path, 30), 61u);
  EXPECT_EQ(path.at(1), (WalkPose{{1, 1.6, -2}, 45, -5}));
  EXPECT_EQ(path.at(-1), path.poses.front());
  EXPECT_EQ(path.at(1e9), path.poses.back());
  const LocalFrame frame{{10, 0, 0}, 4};
  const Camera camera = cameraOf(path.at(1), path.yfov, frame);
  EXPECT_LT(length(camera.position - Vec3d{-2.25, 0.4, -0.5}), 1e-12);
  const WalkPose pose = poseOf(camera, frame);
  EXPECT_NEAR(pose.yaw, 45, 1e-9);
  EXPECT_NEAR(pose.pitch, -5, 1e-9);
}

TEST_F(WalkFile, HostileOnesAreRefused) {
  const auto with = [](const std::string& poses, const std::string& head = R"("rate": 120, "yfov": 45)") {
    return R"({"format": "lucarne-walk", "version": 1, )" + head + R"(, "poses": )" + poses + "}";
  };
  expectRefused("", "");
  expectRefused("[]", "not a recorded walk");
  expectRefused(R"({"format": "other"})", "not a recorded walk");
  expectRefused(R"({"format": "lucarne-walk", "version": 2})", "another version");
  expectRefused(with("[]"), "at least one");
  expectRefused(with("{}"), "list of poses");
  expectRefused(with("[[1,2,3,4]]"), "poses[0]");
  expectRefused(with("[[1,2,3,4,5],[1,2,3,4,\"5\"]]"), "poses[1]");
  expectRefused(with("[[1e300,2,3,4,5]]"), "too large");
  expectRefused(with("[[1,2,3,4,91]]"), "too large");
  expectRefused(with("[[1,2,3,4,5]]", R"("rate": 0, "yfov": 45)"), "rate");
  expectRefused(with("[[1,2,3,4,5]]", R"("rate": -1e99, "yfov": 45)"), "rate");
  expectRefused(with("[[1,2,3,4,5]]", R"("rate": 1, "yfov": 180)"), "yfov");
  std::string many = "[[0,0,0,0,0]";
  for (std::size_t i = 0; i < kMostPoses; ++i) many += ",0";
  expectRefused(with(many + "]"), "more than");
}

}  // namespace
}  // namespace lucarne::walk_driver_test
