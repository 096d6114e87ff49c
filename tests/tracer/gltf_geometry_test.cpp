#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/tracer/gltf_maker.h"

namespace lucarne::gltf_geometry_test {
namespace {

using test::GltfMaker;
using test::squareMaker;
using test::squarePrimitive;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Vec3d metres(const Scene& scene, std::uint32_t t, int k) { return scene.frame.toWorld(Vec3d(scene.corner(t, k))); }

void expectNear(Vec3d a, Vec3d b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(GltfGeometry, IndexedSquareHasTwoTrianglesOfTheDefaultMaterialInALocalFrame) {
  const Scene scene = squareMaker().read();
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_EQ(scene.frame.scale, 1);
  EXPECT_EQ(scene.frame.origin, (Vec3d{0.5, 0.5, 0}));
  EXPECT_EQ(scene.corner(0, 0), (Vec3f{-0.5f, -0.5f, 0}));
  EXPECT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].metallic, 1);
  EXPECT_THAT(scene.leftOut, IsEmpty());
  EXPECT_TRUE(scene.chartOfTriangle.empty());
  EXPECT_NE(scene.source, nullptr);
}

TEST(GltfGeometry, NodeTransformsMultiplyFromTheRootDown) {
  GltfMaker maker = squareMaker();
  maker.json["nodes"][0] = {{"translation", {10, 0, 0}}, {"children", {1}}};
  const double h = std::sqrt(0.5);
  maker.json["nodes"].push_back({{"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}, {"children", {2}}});
  maker.json["nodes"].push_back({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}, {"mesh", 0}});
  const Scene scene = maker.read();
  // (1, 1, 0) → z + 5 → scale (2, 3, 20) → quarter turn about z (−3, 2, 20) → x + 10.
  expectNear(metres(scene, 0, 2), {7, 2, 20});
}

TEST(GltfGeometry, FarFromTheOriginAndInMillimetresGivesTheSameLocalBits) {
  GltfMaker far = squareMaker();
  far.json["nodes"][0]["translation"] = {1e7, -1e7, 1048576};
  GltfMaker big = squareMaker();
  big.json["nodes"][0]["scale"] = {1024, 1024, 1024};
  const Scene plain = squareMaker().read();
  EXPECT_EQ(plain.positions, far.read().positions);
  EXPECT_EQ(plain.positions, big.read().positions);
  EXPECT_EQ(big.read().frame.scale, 1024);
}

TEST(GltfGeometry, MirroringNodesKeepTheFrontInFront) {
  GltfMaker maker = squareMaker();
  maker.json["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = maker.read();
  // The square lies in the plane z = 0 facing +z, mirrored along x: its front still faces +z.
  EXPECT_GT(scene.scaledNormal(0).z, 0);
  EXPECT_EQ(scene.normals[scene.triangles[0].v[0]], (Vec3f{0, 0, 1}));
}

TEST(GltfGeometry, MirroredSmoothNormalsStayOnTheSideOfTheFront) {
  for (const double sign : {1.0, -1.0}) {
    GltfMaker maker = squareMaker();
    const float s = 0.6f, c = 0.8f;
    squarePrimitive(maker)["attributes"]["NORMAL"] = maker.floats({s, 0, c, s, 0, c, s, 0, c, s, 0, c}, "VEC3");
    maker.json["nodes"][0]["scale"] = {sign, 1, 2};
    const Scene scene = maker.read();
    // Inverse transpose of the scale, then unit length.
    const Vec3d expected = normalize(Vec3d{sign * 0.6, 0, 0.8 / 2});
    expectNear(Vec3d(scene.normals[0]), expected);
    EXPECT_EQ(scene.smooth[0], 1);
    EXPECT_EQ(scene.positions.size(), 4u);
  }
}

TEST(GltfGeometry, StripsAndFansGiveTheTrianglesOfTheSpecification) {
  const std::vector<float> pentagon = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0.5f, 2, 0, 0, 1, 0};
  GltfMaker fan;
  fan.mesh({{"attributes", {{"POSITION", fan.floats(pentagon, "VEC3")}}}, {"mode", 6}});
  fan.node({{"mesh", 0}});
  const Scene fanned = fan.read();
  ASSERT_EQ(fanned.triangles.size(), 3u);
  for (std::uint32_t t = 0; t < 3; ++t) {
    EXPECT_GT(fanned.scaledNormal(t).z, 0);
    EXPECT_EQ(fanned.sourceVertex[fanned.triangles[t].v[0]], t + 1);
    EXPECT_EQ(fanned.sourceVertex[fanned.triangles[t].v[2]], 0u);
  }
  GltfMaker strip;
  const std::uint32_t position = strip.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  strip.mesh({{"attributes", {{"POSITION", position}}}, {"indices", strip.shorts({0, 1, 2, 3, 4})}, {"mode", 5}});
  strip.node({{"mesh", 0}});
  const Scene stripped = strip.read();
  ASSERT_EQ(stripped.triangles.size(), 3u);
  for (std::uint32_t t = 0; t < 3; ++t) EXPECT_GT(stripped.scaledNormal(t).z, 0) << t;
  EXPECT_EQ(stripped.sourceVertex[stripped.triangles[1].v[1]], 3u);
}

TEST(GltfGeometry, MissingNormalsAreFlat) {
  GltfMaker maker;
  const std::uint32_t p = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
  maker.mesh({{"attributes", {{"POSITION", p}}}, {"indices", maker.shorts({0, 1, 2, 0, 3, 1})}});
  maker.node({{"mesh", 0}});
  const Scene scene = maker.read();
  EXPECT_EQ(scene.positions.size(), 6u);
  EXPECT_THAT(scene.smooth, ElementsAre(0, 0));
  EXPECT_EQ(scene.normals[scene.triangles[0].v[0]], (Vec3f{0, 0, 1}));
  EXPECT_EQ(scene.normals[scene.triangles[1].v[0]], (Vec3f{0, 1, 0}));
}

TEST(GltfGeometry, BadNormalsAreMendedOrReplacedByTheGeometricOne) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<std::vector<float>> bad = {{0, 0, 0},     {nan, 0, 1},    {inf, 0, 0},  {0, 0, -1},
                                               {1, 0, 0.02f}, {0, 0, 1e-30f}, {0, 0, 3e38f}};
  for (const auto& n : bad) {
    GltfMaker maker = squareMaker();
    squarePrimitive(maker)["attributes"]["NORMAL"] =
        maker.floats({n[0], n[1], n[2], 0, 0, 1, 0, 0, 1, 0, 0, 7}, "VEC3");
    const Scene scene = maker.read();
    for (const Vec3f& normal : scene.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1})) << n[0] << " " << n[2];
    EXPECT_THAT(scene.smooth, ElementsAre(0, 0));
  }
}

TEST(GltfGeometry, DegenerateTrianglesAreKeptWithUnitNormals) {
  GltfMaker maker = squareMaker();
  squarePrimitive(maker)["indices"] = maker.shorts({0, 0, 1, 0, 1, 2, 3, 3, 3});
  const Scene scene = maker.read();
  ASSERT_EQ(scene.triangles.size(), 3u);
  EXPECT_EQ(scene.scaledNormal(0), Vec3d{});
  for (const Vec3f& n : scene.normals) EXPECT_NEAR(length(n), 1, 1e-6);
}

TEST(GltfGeometry, IncompleteLastTriangleIsDropped) {
  GltfMaker maker = squareMaker();
  squarePrimitive(maker)["indices"] = maker.shorts({0, 1, 2, 0, 2});
  EXPECT_EQ(maker.read().triangles.size(), 1u);
}

TEST(GltfGeometry, AllComponentTypesOfPositionsAndTexcoordsAreRead) {
  GltfMaker maker;
  const std::uint32_t p = maker.accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 0, -128, 0}, 5120, "VEC3");
  maker.json["accessors"][p]["normalized"] = true;
  const std::uint32_t uv = maker.accessor<std::uint16_t>({0, 0, 65535, 0, 0, 32768}, 5123, "VEC2");
  maker.json["accessors"][uv]["normalized"] = true;
  const std::uint32_t indices = maker.accessor<std::uint32_t>({2, 1, 0}, 5125, "SCALAR");
  maker.mesh({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", uv}}}, {"indices", indices}});
  maker.node({{"mesh", 0}});
  const Scene scene = maker.read();
  expectNear(metres(scene, 0, 0), {0, -1, 0});
  expectNear(metres(scene, 0, 1), {1, 0, 0});
  EXPECT_EQ(scene.uv0[scene.triangles[0].v[1]], (Vec2f{1, 0}));
  EXPECT_NEAR(scene.uv0[scene.triangles[0].v[0]].y, 32768 / 65535.0, 1e-7);
}

TEST(GltfGeometry, SparseAndStridedAccessorsAreRead) {
  GltfMaker maker = squareMaker();
  const std::uint32_t where = maker.view<std::uint16_t>({1, 2}), values = maker.view<float>({3, 0, 0, 3, 1, 0});
  maker.json["accessors"][0]["sparse"] = {{"count", 2},
                                          {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", values}}}};
  EXPECT_EQ(metres(maker.read(), 0, 1), (Vec3d{3, 0, 0}));
  maker.json["accessors"][0].erase("bufferView");  // zeros but for the sparse elements
  EXPECT_EQ(metres(maker.read(), 0, 2), (Vec3d{3, 1, 0}));
  EXPECT_EQ(metres(maker.read(), 1, 2), (Vec3d{0, 0, 0}));

  GltfMaker strided;
  const std::uint32_t p = strided.floats({0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0}, "SCALAR");
  strided.json["bufferViews"][0]["byteStride"] = 20;
  strided.json["accessors"][p] = {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  strided.mesh({{"attributes", {{"POSITION", p}}}});
  strided.node({{"mesh", 0}});
  EXPECT_EQ(metres(strided.read(), 0, 2), (Vec3d{0, 1, 0}));
}

TEST(GltfGeometry, OnlyTheDefaultSceneIsReadAndWithoutScenesAllRoots) {
  GltfMaker maker = squareMaker();
  maker.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
  EXPECT_EQ(maker.read().triangles.size(), 2u);
  maker.json["scenes"].push_back({{"nodes", {0, 1}}});
  maker.json["scene"] = 1;
  EXPECT_EQ(maker.read().triangles.size(), 4u);
  EXPECT_EQ(maker.read().instances.size(), 2u);
  maker.json.erase("scene");
  EXPECT_EQ(maker.read().triangles.size(), 2u);
  maker.json.erase("scenes");
  EXPECT_EQ(maker.read().triangles.size(), 4u);
}

TEST(GltfGeometry, WhatIsNoTriangleIsLeftOutByName) {
  GltfMaker maker = squareMaker();
  Json lines = squarePrimitive(maker);
  lines["mode"] = 1;
  maker.json["meshes"][0]["primitives"].push_back(lines);
  maker.json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}});
  squarePrimitive(maker)["targets"] = Json::array({{{"POSITION", 0}}});
  squarePrimitive(maker)["attributes"]["COLOR_0"] = 0;
  const Scene scene = maker.read();
  EXPECT_EQ(scene.triangles.size(), 2u);
  EXPECT_THAT(scene.leftOut, Contains("1 primitive of points or lines: left out"));
  EXPECT_THAT(scene.leftOut, Contains("1 primitive without positions: left out"));
  EXPECT_THAT(scene.leftOut, Contains("1 primitive with morph targets: kept in the base shape"));
  EXPECT_THAT(scene.leftOut, Contains("1 primitive with vertex colours: the colours are ignored"));
}

TEST(GltfGeometry, NumbersThatAreNotFiniteAreRefusedByNameAndPlace) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, inf, -inf}) {
    GltfMaker maker = squareMaker();
    maker.json["meshes"][0]["name"] = "table";
    std::memcpy(maker.bytes.data() + 16, &bad, 4);
    EXPECT_THAT(test::complaint(maker),
                HasSubstr("made.gltf: meshes[0] \"table\".primitives[0]: vertex 1 has a position"));
    GltfMaker uv = squareMaker();
    squarePrimitive(uv)["attributes"]["TEXCOORD_0"] = uv.floats({0, 0, 0, 0, bad, 0, 0, 0}, "VEC2");
    EXPECT_THAT(test::complaint(uv), HasSubstr("vertex 2 has texture coordinates"));
  }
  GltfMaker huge = squareMaker();
  huge.json["nodes"][0]["scale"] = {1e200, 1, 1};
  huge.json["nodes"][0]["translation"] = {1e200, 1, 1};
  EXPECT_THAT(test::complaint(huge), HasSubstr("position that is not a finite"));
}

TEST(GltfGeometry, SceneWithoutTrianglesIsRefused) {
  GltfMaker maker = squareMaker();
  maker.json["nodes"][0].erase("mesh");
  EXPECT_THAT(test::complaint(maker), HasSubstr("made.gltf: has no triangles"));
}

TEST(GltfGeometry, ZeroScaleGivesOnePointAndNoNan) {
  GltfMaker maker = squareMaker();
  maker.json["nodes"][0]["scale"] = {0, 0, 0};
  const Scene scene = maker.read();
  for (const Vec3f& p : scene.positions) EXPECT_EQ(p, Vec3f{});
  for (const Vec3f& n : scene.normals) EXPECT_NEAR(length(n), 1, 1e-6);
}

}  // namespace
}  // namespace lucarne::gltf_geometry_test
