#include "tracer/scene/scene_cleanup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/support/scene_builder.h"
#include "tests/tracer/gltf_maker.h"

namespace lucarne::scene_cleanup_test {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Vec3d kA{0, 0, 0}, kB{1, 0, 0}, kC{0, 1, 0.5};

TEST(SceneCleanup, SameCornersInTheSameOrderAreDuplicatesWhereverTheyStart) {
  test::SceneBuilder s;
  s.addTriangle(kA, kB, kC);
  s.addTriangle(kB, kC, kA);
  s.addTriangle(kC, kB, kA);  // the other face
  s.addTriangle(kC, kA, kB, s.addDiffuse(Rgb{0.1f}));
  s.addTriangle(kA, kC, kB);
  s.addTriangle(kA, kB, {0, 1, 0.25});
  const Scene scene = s.build();
  EXPECT_THAT(scene.skipped, ElementsAre(0, 1, 0, 1, 1, 0));
  EXPECT_EQ(scene.duplicateTriangles, 3u);
  EXPECT_EQ(scene.degenerateTriangles, 0u);
}

TEST(SceneCleanup, BothZerosAreTheSamePlace) {
  test::SceneBuilder s;
  s.addTriangle({-1, -1, -1}, {1, 1, 1}, {0, 1, 0.5});
  s.addTriangle({-1, -1, -1}, {1, 1, 1}, {0, 1, 0.5});
  Scene scene = s.build();
  for (Vec3f& p : scene.positions) p.x = p.x == 0 ? 0.f : p.x;
  scene.positions[5].x = -0.f;
  markSkipped(scene);
  EXPECT_THAT(scene.skipped, ElementsAre(0, 1));
}

TEST(SceneCleanup, TrianglesWithoutAreaAreNoDuplicates) {
  test::SceneBuilder s;
  s.addTriangle({-1, -1, -1}, {1, 1, 1}, {0, 1, 0.5});
  s.addTriangle(kA, kA, kB);
  s.addTriangle(kA, kA, kB);
  s.addTriangle({0, 0.5, 0}, {0.25, 0.5, 0}, {1, 0.5, 0});
  s.addTriangle({0, 0.5, 0}, {0.5, 0.5 + 1e-12, 0}, {1, 0.5, 0});
  s.addTriangle({0, 0.5, 0}, {0.5, 0.5 + 1e-6, 0}, {1, 0.5, 0});
  const Scene scene = s.build();
  EXPECT_THAT(scene.skipped, ElementsAre(0, 1, 1, 1, 1, 0));
  EXPECT_EQ(scene.degenerateTriangles, 4u);
  EXPECT_EQ(scene.duplicateTriangles, 0u);
}

TEST(SceneCleanup, MarkingAgainChangesNothing) {
  test::SceneBuilder s;
  s.addTriangle(kA, kB, kC);
  s.addTriangle(kA, kB, kC);
  Scene scene = s.build();
  markSkipped(scene);
  EXPECT_THAT(scene.skipped, ElementsAre(0, 1));
  EXPECT_EQ(scene.duplicateTriangles, 1u);
  Scene empty;
  markSkipped(empty);
  EXPECT_THAT(empty.skipped, IsEmpty());
}

/// A million triangles in a grid, every one twice: squared time would take hours.
TEST(SceneCleanup, TimeIsProportionalToTheTriangles) {
  Scene scene;
  constexpr std::uint32_t kSide = 708;
  for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
    scene.positions.push_back({static_cast<float>(i % kSide) / kSide, static_cast<float>(i / kSide) / kSide, 0});
  }
  for (int copy = 0; copy < 2; ++copy) {
    for (std::uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i) {
      if (i % kSide == kSide - 1) continue;
      scene.triangles.push_back({{i, i + 1, i + kSide + 1}, 0});
      scene.triangles.push_back({{i + kSide + 1, i + kSide, i}, 0});
    }
  }
  const auto start = std::chrono::steady_clock::now();
  markSkipped(scene);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(scene.duplicateTriangles, scene.triangles.size() / 2);
  EXPECT_EQ(scene.degenerateTriangles, 0u);
  EXPECT_LT(seconds.count(), 30);
}

TEST(SceneCleanup, ReaderFindsDuplicatesAcrossInstancesAndSaysSo) {
  test::GltfMaker maker = test::squareMaker();
  maker.node({{"mesh", 0}});
  maker.node({{"mesh", 0}, {"scale", {1, 1, -1}}});  // mirrored in its own plane: the other face
  test::squarePrimitive(maker)["indices"] = maker.shorts({0, 1, 2, 0, 2, 3, 1, 1, 2});
  const Scene scene = maker.read();
  EXPECT_THAT(scene.skipped, ElementsAre(0, 0, 1, 1, 1, 1, 0, 0, 1));
  EXPECT_EQ(scene.duplicateTriangles, 2u);
  EXPECT_EQ(scene.degenerateTriangles, 3u);
  EXPECT_THAT(scene.leftOut, ElementsAre("3 triangles without area: skipped", "2 duplicate triangles: skipped"));
  EXPECT_THAT(test::squareMaker().read().skipped, Each(0));
}

}  // namespace
}  // namespace lucarne::scene_cleanup_test
