#include "player/frustum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "player/camera_choice.h"
#include "tests/player/synthetic_maps.h"

namespace lucarne::frustum_test {
namespace {

/// True if the point falls into the picture of the camera.
bool inPicture(const Camera& camera, double aspect, Vec3d p) {
  const Vec3d e = p - camera.position;
  const double depth = -dot(e, camera.back), y = depth * std::tan(camera.yfov / 2);
  return depth > 0 && std::abs(dot(e, camera.up)) < y && std::abs(dot(e, camera.right)) < y * aspect;
}

TEST(Frustum, NeverHidesAChartThatHasACornerInThePicture) {
  const test::BakedScene room = test::furnishedRoom(4);
  const DrawList list = buildDrawList(room.scene, room.maps);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1), field(0.2, 2), shape(0.3, 3);
  std::size_t hidden = 0, shown = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3d eye{place(random), place(random), place(random)}, target{place(random), place(random), place(random)};
    const Camera camera = lookAt(eye, target, field(random));
    const double aspect = shape(random);
    const auto visible = visibleRuns(Frustum(camera, aspect), list.runs);
    ASSERT_EQ(visible.size(), list.runs.size());
    for (std::size_t r = 0; r < list.runs.size(); ++r) {
      (visible[r] ? shown : hidden) += 1;
      if (visible[r]) continue;
      for (std::uint32_t v = 0; v < list.runs[r].vertexCount; ++v) {
        const float* p = list.vertices[list.runs[r].firstVertex + v].position;
        const Vec3d corner{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
        EXPECT_FALSE(inPicture(camera, aspect, corner));
      }
    }
  }
  EXPECT_GT(hidden, shown / 3);  // and it does hide something
}

TEST(Frustum, WhatIsBehindOrBesideIsHiddenAndWhatIsAroundTheEyeIsNot) {
  const Frustum frustum(lookAt({0, 0, 0}, {0, 0, -1}, 1.0), 1.5);
  EXPECT_TRUE(frustum.mayShow({-1, -1, -5}, {1, 1, -4}));
  EXPECT_TRUE(frustum.mayShow({-1, -1, -1}, {1, 1, 1}));
  EXPECT_FALSE(frustum.mayShow({-1, -1, 4}, {1, 1, 5}));
  EXPECT_FALSE(frustum.mayShow({50, -1, -5}, {51, 1, -4}));
  EXPECT_FALSE(frustum.mayShow({-1, -9, -5}, {1, -8, -4}));
}

}  // namespace
}  // namespace lucarne::frustum_test
