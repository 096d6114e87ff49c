// Charts continue each other along edges that share no ends.
#include <gtest/gtest.h>

#include "dlm/seam_fit.h"
#include "tests/app/bake_fixture.h"

namespace lucarne::seam_overlaps_test {
namespace {

using test::BakedScene;
using test::SceneBuilder;

constexpr double kJoint = 0.037;  // x, off the texels of both sides

/// A strip of floor of its own material from x0 to x1: a chart, its border along z cut at `cuts` (from z = 1 to −1).
void addStrip(SceneBuilder& s, double x0, double x1, Rgb albedo, const std::vector<double>& cuts, double y = 0) {
  const auto m = s.addDiffuse(albedo);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    s.addQuad({x0, y, cuts[i]}, {x1, y, cuts[i]}, {x1, y, cuts[i + 1]}, {x0, y, cuts[i + 1]}, m);
}

void addLamp(SceneBuilder& s) {
  s.addQuad({-0.5, 0.6, -0.5}, {0.6, 0.6, -0.5}, {0.6, 0.6, 0.6}, {-0.5, 0.6, 0.6},
            s.addDiffuse(Rgb(0.5f), {100, 80, 60}));
}

/// Two strips that meet at the joint, each with its own cuts. `gap`: from edge to edge, m.
SceneBuilder floorOfTwo(const std::vector<double>& left, const std::vector<double>& right, double gap = 0) {
  SceneBuilder s;
  addStrip(s, -1, kJoint, {0.6f, 0.5f, 0.4f}, left);
  addStrip(s, kJoint + gap, 1, {0.2f, 0.3f, 0.4f}, right);
  addLamp(s);
  return s;
}

SeamReport seamsOf(const Scene& scene) { return BakedScene(scene, test::quickOptions(200'000, 11)).baked.seams; }

SeamReport seamsOf(const SceneBuilder& s) { return seamsOf(s.build()); }

/// Shading normals of a wave along z on the left, and on the right one `turned` times as steep.
Scene waved(const SceneBuilder& s, double turned) {
  Scene scene = s.build();
  scene.smooth.assign(scene.triangles.size(), 0);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (scene.triangles[t].material > 1) continue;
    scene.smooth[t] = 1;
    for (const std::uint32_t v : scene.triangles[t].v) {
      const double z = scene.frame.toWorld(Vec3d(scene.positions[v])).z;
      scene.normals[v] = Vec3f(normalize(Vec3d{0, 1, 0.3 * z * (scene.triangles[t].material == 0 ? 1 : turned)}));
    }
  }
  return scene;
}

const std::vector<double> kWhole = {1, -1}, kThirds = {1, 0.4, -0.3, -1};

TEST(SeamOverlaps, OfAWholeEdgeAlongThreeAreFitted) {
  const SeamReport shared = seamsOf(floorOfTwo(kWhole, kWhole)), r = seamsOf(floorOfTwo(kWhole, kThirds));
  EXPECT_EQ(r.seams, 3u);
  EXPECT_NEAR(r.length, 2, 1e-6);
  EXPECT_GT(r.jumpBefore, 0.01);
  EXPECT_LT(r.jumpAfter, 0.2 * r.jumpBefore);
  EXPECT_LT(r.jumpAfter, 1.5 * shared.jumpAfter);
  EXPECT_LT(std::abs(r.fluxChange), 1e-4);
}

TEST(SeamOverlaps, OfEdgesShiftedByHalfAreFitted) {
  // From z = 1.5 to −1.5 by halves; the right strip from 1 to −2. They share 2.5 m.
  const SeamReport r = seamsOf(floorOfTwo({1.5, 0.5, -0.5, -1.5}, {1, 0, -1, -2}));
  EXPECT_EQ(r.seams, 5u);
  EXPECT_NEAR(r.length, 2.5, 1e-6);
  EXPECT_LT(r.jumpAfter, 0.2 * r.jumpBefore);
}

TEST(SeamOverlaps, OfManyShortEdgesAreFittedLikeOne) {
  std::vector<double> cuts;
  for (int i = 0; i <= 400; ++i) cuts.push_back(1 - i * 0.005);
  const SeamReport r = seamsOf(floorOfTwo(kWhole, cuts));
  EXPECT_EQ(r.seams, 400u);
  EXPECT_NEAR(r.length, 2, 1e-5);
  EXPECT_LT(r.jumpAfter, 0.2 * r.jumpBefore);
}

TEST(SeamOverlaps, OfSharedEdgesAreThoseThatTheyWere) {
  const SeamReport one = seamsOf(floorOfTwo(kWhole, kWhole)), three = seamsOf(floorOfTwo(kThirds, kThirds));
  EXPECT_EQ(one.seams, 1u);
  EXPECT_EQ(three.seams, 3u);
  EXPECT_NEAR(three.length, one.length, 1e-6);
}

TEST(SeamOverlaps, AcrossAGapOfAMillimetreAreNone) { EXPECT_EQ(seamsOf(floorOfTwo(kWhole, kThirds, 0.001)).seams, 0u); }

TEST(SeamOverlaps, AtARightAngleAreNone) {
  SceneBuilder s;
  addStrip(s, -1, kJoint, {0.6f, 0.5f, 0.4f}, kWhole);
  const auto m = s.addDiffuse(Rgb(0.3f));
  for (std::size_t i = 0; i + 1 < kThirds.size(); ++i)
    s.addQuad({kJoint, 0, kThirds[i]}, {kJoint, 0.5, kThirds[i]}, {kJoint, 0.5, kThirds[i + 1]},
              {kJoint, 0, kThirds[i + 1]}, m);
  addLamp(s);
  EXPECT_EQ(seamsOf(s).seams, 0u);
}

TEST(SeamOverlaps, UnderAWallAreNone) {
  SceneBuilder s = floorOfTwo(kWhole, kThirds);
  const auto m = s.addDiffuse(Rgb(0.5f));
  for (const double turned : {1.0, -1.0})  // a wall without thickness, its foot longer than the joint
    s.addQuad({kJoint, 0, 1.1 * turned}, {kJoint, 0, -1.1 * turned}, {kJoint, 0.3, -1.1 * turned},
              {kJoint, 0.3, 1.1 * turned}, m);
  EXPECT_EQ(seamsOf(s).seams, 0u);
}

// Normals are compared where the shorter edge ends, not at the ends of each.
TEST(SeamOverlaps, AreWhereInterpolatedNormalsAgree) {
  EXPECT_EQ(seamsOf(waved(floorOfTwo(kWhole, kThirds), 1)).seams, 3u);
  EXPECT_EQ(seamsOf(waved(floorOfTwo(kWhole, kThirds), -1)).seams, 0u);
}

/// A second floor of other cuts and material lies in the first: what continues what is not known.
TEST(SeamOverlaps, OfTwoFloorsInOnePlaceAreNone) {
  SceneBuilder s = floorOfTwo(kWhole, kThirds);
  addStrip(s, -1, kJoint, Rgb(0.5f), {1, 0, -1});
  addStrip(s, kJoint, 1, Rgb(0.7f), {1, 0.5, -1});
  EXPECT_EQ(seamsOf(s).seams, 0u);
}

}  // namespace
}  // namespace lucarne::seam_overlaps_test
