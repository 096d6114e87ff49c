// Closed things are closed for light, at any size and place.
//
// LUCARNE_LONG_RAYS=1e9 makes the test of closed meshes trace that many rays, all its meshes together; it traces 2e7
// without.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/tracer/closed_meshes.h"
#include "tests/tracer/photon_runs.h"
#include "tracer/transport/meet.h"

namespace lucarne::robust_rays_test {
namespace {

using test::FluxMeter;
using test::SceneBuilder;

/// Counts hits, and those with a number that is not finite. Backs take light without a word to the sink: they are what
/// the ledger's hits are more.
struct StrictSink {
  std::uint64_t hits = 0, notFinite = 0;
  void hit(const PhotonHit& h) {
    for (const Vec3f& v :
         {h.beta, h.wi, h.n, h.ns, Vec3f(h.hit.position), Vec3f(h.hit.b.x, h.hit.b.y, h.hit.clearance)})
      notFinite += !isFinite(v);
    ++hits;
  }
  void endPhoton() {}
};

struct ClosedScene {
  std::string name;
  Scene scene;
};

/// Boxes and bumpy balls of several sizes, near and far from the origin, with a bulb inside, off the middle.
std::vector<ClosedScene> closedScenes(Rgb albedo) {
  std::vector<ClosedScene> scenes;
  const Vec3d far{1e5, -1e5, 1e5};
  for (const auto& [size, at] : {std::pair{1e-3, Vec3d{}}, {1.0, Vec3d{}}, {1e4, Vec3d{}}, {1.0, far}, {1e-3, far}}) {
    const std::string place = std::to_string(size) + " m at " + std::to_string(at.x);
    SceneBuilder box, ball;
    box.addBox(at, at + Vec3d{4, 3, 5} * size, box.addDiffuse(albedo), true);
    box.addLight(test::bulbLight(at + Vec3d{1.3, 2.2, 1.7} * size, Rgb(1.f)));
    scenes.push_back({"box of " + place, box.build()});
    test::BumpyBall(at, size, 9).addTo(ball, ball.addDiffuse(albedo));
    ball.addLight(test::bulbLight(at + Vec3d{0.2, 0.1, -0.3} * size, Rgb(1.f)));
    scenes.push_back({"ball of " + place, ball.build()});
  }
  return scenes;
}

double raysToTrace() {
  const char* typed = std::getenv("LUCARNE_LONG_RAYS");
  return typed == nullptr ? 2e7 : std::atof(typed);
}

TEST(RobustRays, NoPhotonLeavesAClosedMesh) {
  const std::vector<ClosedScene> scenes = closedScenes(Rgb(0.9f));
  const double raysEach = raysToTrace() / static_cast<double>(scenes.size());
  for (const ClosedScene& s : scenes) {
    const PhotonScene photons(s.scene);
    StrictSink sink;
    Ledger l;
    constexpr std::uint64_t kBatch = 10'000;
    for (std::uint64_t first = 0; static_cast<double>(l.rays) < raysEach; first += kBatch)
      flyPhotons(photons, {first, first + kBatch}, 31, {}, sink, l);
    test::expectBalance(l);
    EXPECT_TRUE(l.escaped == FluxSum{}) << s.name << ": " << test::share(l.escaped, l) * static_cast<double>(l.photons)
                                        << " photons of " << l.photons << ", " << l.rays << " rays";
    EXPECT_EQ(sink.notFinite, 0u) << s.name;
    // Of a thousand million rays one was seen to start, by rounding, behind the neighbour of its triangle.
    EXPECT_LE(l.hits - sink.hits, l.rays / 50'000'000) << s.name << ": light ended at a back";
  }
}

/// Where walls meet at an angle so sharp that they are nearer to each other than rays start from them, a ray may start
/// behind the other wall. It is not lost, but ends there.
TEST(RobustRays, NoPhotonLeavesAMeshOfSpikes) {
  // Of a million photons the hard ones are among these.
  for (const auto& [cells, first] : {std::pair{5, 0}, {15, 210'000}, {40, 240'000}})
    for (const double depth : {0.9, 0.999}) {
      SceneBuilder b;
      test::BumpyBall({}, 1, cells, depth).addTo(b, b.addDiffuse(Rgb(0.95f)));
      b.addLight(test::bulbLight({0, 0, 0}, Rgb(1.f)));
      const Scene scene = b.build();
      const PhotonScene photons(scene);
      StrictSink sink;
      Ledger l;
      const auto begin = static_cast<std::uint64_t>(first);
      flyPhotons(photons, {begin, begin + 10'000}, 31, {}, sink, l);
      test::expectBalance(l);
      EXPECT_TRUE(l.escaped == FluxSum{})
          << cells << " " << depth << ": " << test::share(l.escaped, l) * static_cast<double>(l.photons) << " photons, "
          << l.rays << " rays";
      EXPECT_LE(l.hits - sink.hits, 2u) << cells << " " << depth;
    }
}

/// Places on a mesh that rays are aimed at.
struct Targets {
  std::vector<Vec3f> corners, edges;
  explicit Targets(const Scene& scene) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const Vec3f a = scene.corner(t, k), b = scene.corner(t, (k + 1) % 3);
        corners.push_back(a);
        edges.push_back((a + b) * 0.5f);
        for (int i = 0; i < 3; ++i) edges.push_back(a + (b - a) * unit(random));
      }
  }
};

struct Aimed {
  std::uint64_t missed = 0, backs = 0;
};

/// Rays from 30 places about the bulb: those that meet nothing, and those that meet a back.
Aimed aimAt(const PhotonScene& photons, const std::vector<Vec3f>& targets) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(0, 0.05f);
  Aimed aimed;
  std::uint64_t repeats = 0;
  for (int i = 0; i < 30; ++i) {
    const Vec3f o = Vec3f(photons.scene().lights[0].position) + Vec3f{unit(random), unit(random), unit(random)};
    for (const Vec3f& t : targets) {
      Hit hit;
      const bool met = meetSurface<false>(
          photons, {o, normalize(t - o), kNone}, repeats, [](std::uint32_t) {}, [](const Hit&) { return false; }, hit);
      aimed.missed += !met;
      aimed.backs += met && hit.back;
    }
  }
  return aimed;
}

TEST(RobustRays, RaysTowardEdgesAndCornersMeetTheFrontsOfAClosedMesh) {
  for (const ClosedScene& s : closedScenes(Rgb(0.5f))) {
    const PhotonScene photons(s.scene);
    const Targets targets(s.scene);
    for (const auto* places : {&targets.edges, &targets.corners}) {
      const Aimed aimed = aimAt(photons, *places);
      EXPECT_EQ(aimed.missed, 0u) << s.name << " of " << 30 * places->size();
      EXPECT_EQ(aimed.backs, 0u) << s.name << " of " << 30 * places->size();
    }
  }
}

TEST(RobustRays, WithoutTheRobustModeRaysTowardEdgesAreLost) {
  const ClosedScene ball = std::move(closedScenes(Rgb(0.5f))[1]);
  const PhotonScene photons(ball.scene, RayCasterOptions{"", false});
  EXPECT_GT(aimAt(photons, Targets(ball.scene).edges).missed, 0u);
}

/// Two halves of a room of 10 m with a wall of 1 mm between them that ends at (or in) the room's walls; light in one.
Scene dividedRoom(double into) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {10, 3, 10}, b.addDiffuse(Rgb(0.9f)), true);
  b.addBox({5, -into, -into}, {5.001, 3 + into, 10 + into}, b.addDiffuse(Rgb(0.9f)), false);
  b.addLight(test::bulbLight({2.5, 1.5, 5}, Rgb(100.f)));
  return b.build();
}

TEST(RobustRays, AWallOfAMillimetreKeepsLightOnItsSide) {
  for (const double into : {0.0, 0.1}) {
    const Scene scene = dividedRoom(into);
    const auto place = [&](const PhotonHit& h) { return scene.frame.toWorld(h.hit.position).x < 5.0005 ? 0 : 1; };
    FluxMeter meter(2, place);
    const Ledger l = test::fly(PhotonScene(scene), 100'000, meter);
    test::expectBalance(l);
    test::expectNothingEscapes(l);
    EXPECT_GT(meter[0].sum, 0);
    EXPECT_EQ(meter[1].sum, 0) << "light leaked, wall into the room's walls by " << into;
  }
}

TEST(RobustRays, TwoRoomsWallToWallShareNoLight) {
  SceneBuilder b;
  const auto walls = b.addDiffuse(Rgb(0.9f));
  b.addBox({0, 0, 0}, {5, 3, 10}, walls, true);
  b.addBox({5, 0, 0}, {10, 3, 10}, walls, true);
  b.addLight(test::bulbLight({2.5, 1.5, 5}, Rgb(100.f)));
  const Scene scene = b.build();
  FluxMeter meter(2, [](const PhotonHit& h) { return h.hit.triangle / 12; });
  const Ledger l = test::fly(PhotonScene(scene), 100'000, meter);
  test::expectBalance(l);
  test::expectNothingEscapes(l);
  EXPECT_GT(meter[0].sum, 0);
  EXPECT_EQ(meter[1].sum, 0);
}

/// On a plain of 10 km, a box of 1 m with walls of 1 cm and a bulb in it.
Scene boxOnAPlain(Vec3d at) {
  SceneBuilder b;
  test::addPlate(b, 0, 5000, b.addDiffuse(Rgb(0.9f)));
  b.addBox(at, at + Vec3d(1), b.addDiffuse(Rgb(0.9f)), false);
  b.addBox(at + Vec3d(0.01), at + Vec3d(0.99), b.addDiffuse(Rgb(0.9f)), true);
  b.addLight(test::bulbLight(at + Vec3d{0.3, 0.6, 0.4}, Rgb(10.f)));
  return b.build();
}

TEST(RobustRays, ASmallBoxInALargeSceneKeepsItsLight) {
  for (const Vec3d at : {Vec3d{2, 0.5, 3}, Vec3d{4000, 0.5, -4500}}) {
    const Scene scene = boxOnAPlain(at);
    std::uint64_t met = 0;
    const auto place = [&](const PhotonHit& h) { return ++met, h.hit.material; };
    FluxMeter meter(2, place);
    const Ledger l = test::fly(PhotonScene(scene), 100'000, meter);
    test::expectBalance(l);
    test::expectNothingEscapes(l);
    EXPECT_EQ(meter[0].sum, 0) << "the plain";
    EXPECT_EQ(meter[1].sum, 0) << "the outside of the box";
    EXPECT_EQ(l.hits, met) << "light ended at the back of a wall";
  }
}

/// The hits of each photon.
struct HitRecorder {
  using Hits = std::vector<std::pair<std::uint32_t, Vec3d>>;
  std::vector<Hits> photons{1};
  void hit(const PhotonHit& h) { photons.back().emplace_back(h.hit.triangle, h.hit.position); }
  void endPhoton() { photons.emplace_back(); }
};

Scene ballWithABulb() {
  SceneBuilder b;
  test::BumpyBall({}, 1, 5).addTo(b, b.addDiffuse(Rgb(0.8f)));
  b.addLight(test::bulbLight({0.2, 0.1, -0.3}, Rgb(1.f)));
  return b.build();
}

void addTriangle(Scene& scene, Vec3f a, Vec3f b, Vec3f c) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  scene.positions.insert(scene.positions.end(), {a, b, c});
  scene.normals.insert(scene.normals.end(), 3, Vec3f(normalize(cross(Vec3d(b - a), Vec3d(c - a)))));
  scene.uv0.resize(scene.positions.size());
  scene.triangles.push_back({{first, first + 1, first + 2}, 0});
  scene.smooth.push_back(0);
}

/// Expects the same hits of the same photons as in the ball alone, to the last bit.
void expectSameHitsAsInTheBall(const Scene& scene) {
  const Scene ball = ballWithABulb();
  HitRecorder without, with;
  const Ledger a = test::fly(PhotonScene(ball), 30'000, without), b = test::fly(PhotonScene(scene), 30'000, with);
  test::expectBalance(b);
  test::expectNothingEscapes(b);
  EXPECT_EQ(a.rays, b.rays);
  std::size_t different = 0;
  for (std::size_t i = 0; i < without.photons.size(); ++i) different += without.photons[i] != with.photons[i];
  EXPECT_EQ(different, 0u) << "photons";
}

TEST(RobustRays, TrianglesWithoutAreaAndDuplicatesChangeNoHit) {
  Scene scene = ballWithABulb();
  const auto count = static_cast<std::uint32_t>(scene.triangles.size());
  for (std::uint32_t t = 0; t < count; t += 3) {
    const Vec3f a = scene.corner(t, 0), b = scene.corner(t, 1), c = scene.corner(t, 2);
    addTriangle(scene, b, c, a);                                         // a duplicate, turned
    addTriangle(scene, a, a, scene.corner((t + count / 2) % count, 0));  // an edge right through the ball
    addTriangle(scene, c, c, c);                                         // a point
  }
  markSkipped(scene);
  ASSERT_EQ(scene.duplicateTriangles, count / 3);
  ASSERT_EQ(scene.degenerateTriangles, 2 * (count / 3));
  expectSameHitsAsInTheBall(scene);
}

// How far off its triangle a ray starts depends on the edges around, and on nothing else.
TEST(RobustRays, TrianglesThatNoRayMeetsChangeNoHit) {
  Scene scene = ballWithABulb();
  for (int i = 0; i < 3000; ++i) {  // outside, far longer than the ball's own
    const float z = 1.5f + 1e-4f * static_cast<float>(i);
    addTriangle(scene, {-1, 1.5f, z}, {1, 1.5f, z}, {1, 1.6f, z});
  }
  markSkipped(scene);
  expectSameHitsAsInTheBall(scene);
}

// Needles, fans and slivers: the numbers of a hit stay finite on the worst of triangles.
TEST(RobustRays, NeedlesGiveFiniteNumbers) {
  SceneBuilder b;
  const auto walls = b.addDiffuse(Rgb(0.9f));
  b.addBox({-1, -1, -1}, {1, 1, 1}, walls, true);
  for (int i = 0; i < 200; ++i) {
    const double x = -0.9 + 0.009 * i, thin = std::ldexp(1.0, -5 - i % 25);
    b.addTriangle({x, -0.9, 0}, {x + thin, 0.9, 0}, {x, 0.9, 0.3 * thin}, walls);
  }
  b.addLight(test::bulbLight({0.5, 0.5, 0.5}, Rgb(1.f)));
  const Scene scene = b.build();
  StrictSink sink;
  const Ledger l = test::fly(PhotonScene(scene), 50'000, sink);
  test::expectBalance(l);
  test::expectNothingEscapes(l);
  EXPECT_EQ(sink.notFinite, 0u);
}

}  // namespace
}  // namespace lucarne::robust_rays_test
