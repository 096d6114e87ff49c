// Tangents of normal maps: from the file or computed. The square lies in z = 0 and faces +z.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/tracer/gltf_maker.h"
#include "tracer/scene/gltf_writer.h"

namespace lucarne::gltf_tangents_test {
namespace {

using test::GltfMaker;
using test::squarePrimitive;
using test::squareWith;
using test::withTexture;
using ::testing::HasSubstr;

const std::vector<float> kUpright = {0, 1, 1, 1, 1, 0, 0, 0};  // of corners (0,0) (1,0) (1,1) (0,1); v points down

/// The square with a normal map, normals and texture coordinates.
GltfMaker mapped(const std::vector<float>& uv, const Json& use = {{"index", 0}}) {
  GltfMaker maker = withTexture(squareWith({{"normalTexture", use}}));
  Json& attributes = squarePrimitive(maker)["attributes"];
  attributes["NORMAL"] = maker.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  attributes["TEXCOORD_0"] = maker.floats(uv, "VEC2");
  return maker;
}

void give(GltfMaker& maker, const std::vector<float>& tangent) {
  std::vector<float> all;
  for (int i = 0; i < 4; ++i) all.insert(all.end(), tangent.begin(), tangent.end());
  squarePrimitive(maker)["attributes"]["TANGENT"] = maker.floats(all, "VEC4");
}

void expectNear(Vec4f a, Vec4f b) {
  EXPECT_NEAR(a.x, b.x, 1e-6);
  EXPECT_NEAR(a.y, b.y, 1e-6);
  EXPECT_NEAR(a.z, b.z, 1e-6);
  EXPECT_EQ(a.w, b.w);
}

/// All corners have this tangent.
void expectAll(const Scene& scene, Vec4f tangent) {
  ASSERT_EQ(scene.tangents.size(), scene.positions.size());
  for (const Triangle& t : scene.triangles) {
    for (const std::uint32_t v : t.v) expectNear(scene.tangents[v], tangent);
  }
}

void expectFrames(const Scene& scene) {
  ASSERT_EQ(scene.tangents.size(), scene.positions.size());
  for (std::size_t v = 0; v < scene.tangents.size(); ++v) {
    const Vec3f t{scene.tangents[v].x, scene.tangents[v].y, scene.tangents[v].z};
    EXPECT_NEAR(length(t), 1, 1e-6) << v;
    EXPECT_NEAR(dot(t, scene.normals[v]), 0, 1e-6) << v;
    EXPECT_EQ(std::fabs(scene.tangents[v].w), 1) << v;
  }
}

TEST(Tangents, AreNotThereWithoutANormalMapThatIsUsed) {
  GltfMaker maker = mapped(kUpright);
  give(maker, {1, 0, 0, 1});
  maker.json["materials"].push_back(Json::object());
  squarePrimitive(maker)["material"] = 1;
  EXPECT_TRUE(maker.read().tangents.empty());
}

TEST(Tangents, RunAlongUWithTheBitangentUpInTheImage) {
  expectAll(mapped(kUpright).read(), {1, 0, 0, 1});
  // Turned by a quarter: u runs along +y, up in the image is −x; and that mirrored: up is +x.
  expectAll(mapped({0, 0, 0, 1, 1, 1, 1, 0}).read(), {0, 1, 0, 1});
  expectAll(mapped({0, 1, 0, 0, 1, 0, 1, 1}).read(), {0, 1, 0, -1});
  // Mirrored: u runs along −x, up in the image is still +y.
  expectAll(mapped({1, 1, 0, 1, 0, 0, 1, 0}).read(), {-1, 0, 0, -1});
  // Sheared: along u the height in the image does not change.
  expectAll(mapped({0, 0, 1, 0, 2, -1, 1, -1}).read(), {1, 0, 0, 1});
}

TEST(Tangents, FollowTheTransformAndTheSetOfTheNormalMap) {
  const Json turned = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 1.5707963267948966}}}}}};
  // (u, v) → (v, −u): u' runs where v did, down.
  expectAll(mapped(kUpright, turned).read(), {0, -1, 0, 1});
  const Json flipped = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {-1, 1}}}}}}};
  expectAll(mapped(kUpright, flipped).read(), {-1, 0, 0, -1});
  GltfMaker other = mapped(kUpright, {{"index", 0}, {"texCoord", 3}});
  squarePrimitive(other)["attributes"]["TEXCOORD_3"] = other.floats({1, 0, 0, 0, 0, 1, 1, 1}, "VEC2");  // half a turn
  expectAll(other.read(), {-1, 0, 0, 1});
}

TEST(Tangents, OfTheFileTurnWithTheNodeAndStandOnTheNormal) {
  GltfMaker maker = mapped(kUpright);
  give(maker, {0, 1, 0, -1});  // not what the texture coordinates say
  expectAll(maker.read(), {0, 1, 0, -1});
  maker.json["nodes"][0]["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
  expectAll(maker.read(), {-1, 0, 0, -1});
  GltfMaker skew = mapped(kUpright);
  give(skew, {3, 0, 4, 1});
  expectAll(skew.read(), {1, 0, 0, 1});
  GltfMaker stretched = mapped(kUpright);
  give(stretched, {1, 1, 0, 1});
  stretched.json["nodes"][0]["scale"] = {3, 4, 1};  // as a vector of the surface, not as a normal
  expectAll(stretched.read(), {0.6f, 0.8f, 0, 1});
}

TEST(Tangents, GivenAndComputedAgreeWhereNodesMirror) {
  for (const Json& scale : {Json{1, 1, 1}, Json{-1, 1, 1}, Json{1, -2, 1}, Json{1, 1, -1}, Json{-1, -1, -3}}) {
    GltfMaker computed = mapped(kUpright), given = computed;
    give(given, {1, 0, 0, 1});
    computed.json["nodes"][0]["scale"] = given.json["nodes"][0]["scale"] = scale;
    const Scene a = computed.read(), b = given.read();
    expectFrames(a);
    expectAll(a, b.tangents[0]);
    expectAll(b, b.tangents[0]);
    // The image's up is the square's +y, whatever the node does.
    const Vec3f t{b.tangents[0].x, b.tangents[0].y, b.tangents[0].z};
    EXPECT_EQ(cross(b.normals[0], t).y * b.tangents[0].w > 0, scale[1] > 0) << scale;
    EXPECT_EQ(t.x > 0, scale[0] > 0) << scale;
  }
}

TEST(Tangents, WithoutNormalsThoseOfTheFileDoNotCount) {
  GltfMaker maker = mapped(kUpright);
  give(maker, {0, 1, 0, -1});
  squarePrimitive(maker)["attributes"].erase("NORMAL");
  expectAll(maker.read(), {1, 0, 0, 1});
}

TEST(Tangents, MeanIsWeighedByTheAngles) {
  // About the origin two triangles in z = 0: one of a right angle whose u runs along +x, and one of half of that whose
  // texture is turned so that u runs along +y there. They share the origin's position, normal and coordinates.
  GltfMaker maker = withTexture(squareWith({{"normalTexture", {{"index", 0}}}}));
  Json& primitive = squarePrimitive(maker);
  const std::uint32_t p = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, -1, -1, 0}, "VEC3");
  std::vector<float> normals;
  for (int i = 0; i < 6; ++i) normals.insert(normals.end(), {0, 0, 1});
  const std::uint32_t n = maker.floats(normals, "VEC3");
  const std::uint32_t uv = maker.floats({0, 0, 1, 0, 0, -1, 0, 0, 0, -1, -1, -1}, "VEC2");
  primitive = {{"material", 0}, {"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", uv}}}};
  const Scene scene = maker.read();
  const Vec3f mean = normalize(Vec3f{2, 1, 0});
  expectNear(scene.tangents[scene.triangles[0].v[0]], {mean.x, mean.y, 0, 1});
  expectNear(scene.tangents[scene.triangles[1].v[0]], {mean.x, mean.y, 0, 1});
  expectNear(scene.tangents[scene.triangles[0].v[1]], {1, 0, 0, 1});
  expectNear(scene.tangents[scene.triangles[1].v[1]], {0, 1, 0, 1});
}

TEST(Tangents, VerticesAreSplitWhereMirroredTextureMeetsUpright) {
  // Triangle 0 1 2 upright, 0 2 3 the mirror image across the diagonal.
  GltfMaker maker = mapped({0, 1, 1, 1, 1, 0, 1, 1});
  const Scene scene = maker.read();
  EXPECT_EQ(scene.positions.size(), 6u);
  EXPECT_EQ(scene.instances[0].vertexCount, 6u);
  expectFrames(scene);
  for (std::size_t k = 0; k < 3; ++k) {
    expectNear(scene.tangents[scene.triangles[0].v[k]], {1, 0, 0, 1});
    expectNear(scene.tangents[scene.triangles[1].v[k]], {0, 1, 0, -1});
  }
  for (const std::uint32_t v : {4u, 5u}) {
    const std::uint32_t original = scene.sourceVertex[v];
    EXPECT_EQ(scene.positions[v], scene.positions[original]);
    EXPECT_EQ(scene.normals[v], scene.normals[original]);
    EXPECT_EQ(scene.uv0[v], scene.uv0[original]);
  }
}

TEST(Tangents, OfDegenerateCoordinatesAreAnyInThePlane) {
  expectFrames(mapped({0, 0, 0, 0, 0, 0, 0, 0}).read());
  expectFrames(mapped({0, 0, 1, 1, 2, 2, 3, 3}).read());
  expectFrames(mapped({1e29f, 0, -1e29f, 1e29f, 0, 1e-38f, 0, 0}).read());
  GltfMaker none = mapped(kUpright);
  squarePrimitive(none)["attributes"].erase("TEXCOORD_0");
  expectFrames(none.read());
  GltfMaker flat = mapped(kUpright);
  squarePrimitive(flat)["indices"] = flat.shorts({0, 0, 1, 0, 1, 2, 3, 3, 3});
  expectFrames(flat.read());
  GltfMaker point = mapped(kUpright);
  point.json["nodes"][0]["scale"] = {0, 0, 0};
  expectFrames(point.read());
}

TEST(Tangents, OfTheFileThatAreNoDirectionsAreAnyInThePlane) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const std::vector<float>& bad : std::vector<std::vector<float>>{
           {0, 0, 0, 0}, {nan, 0, 0, nan}, {inf, 1, 0, -inf}, {0, 0, 1, 1}, {1e-38f, 0, 0, 1}, {3e38f, 3e38f, 0, 2}}) {
    GltfMaker maker = mapped(kUpright);
    give(maker, bad);
    expectFrames(maker.read());
  }
  GltfMaker three = mapped(kUpright);
  squarePrimitive(three)["attributes"]["TANGENT"] = squarePrimitive(three)["attributes"]["NORMAL"];
  EXPECT_THAT(test::complaint(three), HasSubstr("TANGENT: has 3 components, not 4"));
}

TEST(Tangents, OfVerticesWithoutNormalMapFillTheGaps) {
  GltfMaker maker = mapped(kUpright);
  maker.json["materials"].push_back(Json::object());
  Json plain = squarePrimitive(maker);
  plain["material"] = 1;
  plain["attributes"].erase("TEXCOORD_0");
  Json& primitives = maker.json["meshes"][0]["primitives"];
  primitives = {plain, primitives[0], plain};
  const Scene scene = maker.read();
  expectFrames(scene);
  ASSERT_EQ(scene.positions.size(), 12u);
  expectNear(scene.tangents[4], {1, 0, 0, 1});
}

TEST(Tangents, ComeBackBitForBitFromAScenePlacedInAnAtlas) {
  GltfMaker maker = mapped({0, 1, 1.1f, 1, 0.9f, 0.2f, 1.3f, 0.7f});
  maker.json["nodes"][0]["rotation"] = {0.1, 0.2, 0.3, 0.9};
  const Scene scene = maker.read();
  AtlasUv uv;
  for (std::uint32_t t = 0; t < 2; ++t) {
    const float x = 0.5f * static_cast<float>(t);
    uv.corner.push_back({Vec2f{x, 0}, Vec2f{x, 1}, Vec2f{x + 0.5f, 1}});
    uv.chartOfTriangle.push_back(t);
  }
  const Scene again = readGlb(writeSceneGlb(scene, uv), "again.glb");
  for (std::uint32_t t = 0; t < 2; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(again.tangents[again.triangles[t].v[k]], scene.tangents[scene.triangles[t].v[k]]) << t << k;
    }
  }
}

}  // namespace
}  // namespace lucarne::gltf_tangents_test
