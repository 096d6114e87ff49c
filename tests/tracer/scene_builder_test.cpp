#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

namespace lucarne::scene_builder_test {
namespace {

TEST(SceneBuilder, BoxesFaceOutwardOrInwardAsAsked) {
  for (const bool inward : {false, true}) {
    test::SceneBuilder builder;
    builder.addBox({-1, -2, -3}, {1, 2, 3}, 0, inward);
    const Scene scene = builder.build();
    ASSERT_EQ(scene.triangles.size(), 12u);
    for (std::uint32_t t = 0; t < 12; ++t) {
      const Vec3d out(scene.corner(t, 0) + scene.corner(t, 1) + scene.corner(t, 2));
      EXPECT_EQ(dot(out, scene.scaledNormal(t)) > 0, !inward) << t;
      EXPECT_GT(dot(Vec3d(scene.normals[scene.triangles[t].v[0]]), scene.scaledNormal(t)), 0) << t;
    }
  }
}

TEST(LocalFrame, LargestExtentLiesBetweenOneAndTwoAndScalingByTwoKeepsTheBits) {
  for (const double size : {1e-30, 1e-6, 0.3, 1.0, 1.999, 2.0, 7.0, 1e6, 1e30}) {
    test::SceneBuilder one, two;
    one.addQuad({size * 5, 0, 0}, {size * 6, 0, 0}, {size * 6, size * 0.7, 0}, {size * 5, size * 0.7, 0});
    two.addQuad({size * 10, 0, 0}, {size * 12, 0, 0}, {size * 12, size * 1.4, 0}, {size * 10, size * 1.4, 0});
    const Scene a = one.build(), b = two.build();
    EXPECT_EQ(a.positions, b.positions) << size;
    EXPECT_EQ(a.frame.scale * 2, b.frame.scale);
    const float extent = a.positions[1].x - a.positions[0].x;
    EXPECT_GE(extent, 1 - 1e-6f) << size;
    EXPECT_LT(extent, 2 + 1e-6f) << size;
  }
}

TEST(LocalFrame, FarFromTheOriginNothingIsLost) {
  test::SceneBuilder near, far;
  const double shift = 1048576;
  near.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 0.5, 0.25});
  far.addTriangle({shift, 0, 0}, {shift + 1, 0, 0}, {shift, 0.5, 0.25});
  EXPECT_EQ(near.build().positions, far.build().positions);
}

TEST(LocalFrame, OnePointHasTheScaleOne) {
  Box box;
  box.add({3, 4, 5});
  EXPECT_EQ(localFrameOf(box).scale, 1);
  EXPECT_EQ(localFrameOf(box).origin, (Vec3d{3, 4, 5}));
}

}  // namespace
}  // namespace lucarne::scene_builder_test
