#include "tracer/scene/gltf_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"
#include "tests/tracer/gltf_maker.h"
#include "tracer/scene/gltf_accessor.h"
#include "tracer/scene/gltf_source.h"
#include "tracer/scene/png_bytes.h"

namespace lucarne::gltf_writer_test {
namespace {

using test::GltfMaker;
using test::squareMaker;
using test::squarePrimitive;

/// Every triangle in a cell of its own; charts of three triangles, every fifth triangle without one.
AtlasUv someAtlas(const Scene& scene) {
  AtlasUv uv;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const float x = static_cast<float>(t % 8) / 8, y = static_cast<float>(t / 8) / 8;
    uv.corner.push_back({Vec2f{x, y}, Vec2f{x + 0.1f, y}, Vec2f{x, y + 0.1f}});
    uv.chartOfTriangle.push_back(t % 5 == 4 ? kNone : t / 3);
  }
  return uv;
}

void expectSame(const Scene& a, const Scene& b, const AtlasUv& uv) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  EXPECT_EQ(b.chartOfTriangle, uv.chartOfTriangle);
  EXPECT_EQ(a.smooth, b.smooth);
  for (std::uint32_t t = 0; t < a.triangles.size(); ++t) {
    EXPECT_EQ(a.triangles[t].material, b.triangles[t].material) << t;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = a.triangles[t].v[k], w = b.triangles[t].v[k];
      EXPECT_EQ(a.positions[v], b.positions[w]) << t;
      EXPECT_EQ(a.normals[v], b.normals[w]) << t;
      EXPECT_EQ(b.atlasUv[w], uv.corner[t][k]) << t;
      EXPECT_EQ(a.uv0.empty() ? Vec2f{} : a.uv0[v], b.uv0.empty() ? Vec2f{} : b.uv0[w]) << t;
    }
  }
}

/// Written and read again; checks identity, and that writing that again gives the same bytes.
Scene roundTrip(const Scene& scene) {
  const AtlasUv uv = someAtlas(scene);
  const std::vector<std::uint8_t> glb = writeSceneGlb(scene, uv);
  Scene again = readGlb(glb, "again.glb");
  expectSame(scene, again, uv);
  EXPECT_EQ(writeSceneGlb(again, uv), glb);
  return again;
}

const Json& attributesOf(const Scene& scene, std::size_t mesh = 0, std::size_t primitive = 0) {
  return scene.source->json["meshes"][mesh]["primitives"][primitive]["attributes"];
}

TEST(GltfWriter, SquareComesBackBitForBitWithItsPlaceInTheAtlas) {
  const Scene again = roundTrip(squareMaker().read());
  EXPECT_EQ(again.positions.size(), 6u);
  EXPECT_TRUE(again.uv0.empty());
  EXPECT_TRUE(attributesOf(again).contains("TEXCOORD_0"));
}

TEST(GltfWriter, StripsFansMirrorsAndSharedMeshesComeBackBitForBit) {
  GltfMaker maker;
  const std::uint32_t position =
      maker.floats({0, 0, 0, 1, 0, 0.1f, 0, 1, 0, 1, 1, 0.2f, 0, 2, 0, 1.1f, 2, 0.3f}, "VEC3");
  const std::uint32_t normal = maker.floats({0, 0, 1, 0, 0.1f, 1, 0, 0, 1, 0, 0.2f, 1, 0, 0, 1, 0, 0, 0}, "VEC3");
  const Json attributes = {{"POSITION", position}, {"NORMAL", normal}};
  maker.mesh({{"attributes", attributes}, {"mode", 5}});
  maker.json["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", 6}});
  maker.json["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", 0}});
  maker.json["meshes"][0]["primitives"].push_back(
      {{"attributes", attributes}, {"indices", maker.shorts({0, 1, 2, 0, 0, 0, 3, 4, 5})}});
  maker.node({{"mesh", 0}, {"rotation", {0.1, 0.2, 0.3, 0.9}}});
  maker.node({{"mesh", 0}, {"scale", {-1, 2, 0.3}}, {"translation", {1e5, 3, 0.1}}});
  maker.json["nodes"].push_back({{"mesh", 0}, {"name", "outside of the scene"}});
  const Scene again = roundTrip(maker.read());
  EXPECT_EQ(again.triangles.size(), 22u);
  EXPECT_EQ(again.source->json["meshes"].size(), 3u);
  EXPECT_EQ(again.source->json["nodes"][2]["mesh"], 0);
  EXPECT_EQ(attributesOf(again, 0).size(), 2u);  // of the node outside: as it was
}

TEST(GltfWriter, NothingOfTheDocumentIsLost) {
  GltfMaker maker = squareMaker();
  const std::vector<float> times = {0, 1, 2};
  const std::uint32_t input = maker.floats(times, "SCALAR"), output = maker.floats({0, 0, 0, 1, 1, 1, 2, 2, 2}, "VEC3");
  maker.json["animations"] =
      Json::array({{{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}})},
                    {"samplers", Json::array({{{"input", input}, {"output", output}}})}}});
  maker.json["extras"] = {{"author", "someone"}, {"list", {1, 2, {{"deep", true}}}}};
  maker.json["nodes"][0]["extras"] = "note";
  maker.json["nodes"][0]["extensions"]["ACME_wobble"] = {{"accessor", 0}};
  maker.json["extensionsUsed"] = {"ACME_wobble"};
  maker.json["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
  maker.node({{"camera", 0}});
  const Scene scene = maker.read();
  const Scene again = readGlb(writeSceneGlb(scene, someAtlas(scene)), "again.glb");
  for (const char* key : {"extras", "extensionsUsed", "cameras", "scenes", "scene", "asset"}) {
    EXPECT_EQ(again.source->json[key], scene.source->json[key]) << key;
  }
  EXPECT_EQ(again.source->json["nodes"], scene.source->json["nodes"]);
  const Json& sampler = again.source->json["animations"][0]["samplers"][0];
  const Accessor kept(*again.source, sampler["input"].get<std::uint32_t>());
  ASSERT_EQ(kept.count(), 3u);
  EXPECT_EQ(kept.value(2, 0), 2);
  const Accessor unseen(*again.source, 0);  // the extension may mean it
  EXPECT_EQ(unseen.count(), 4u);
  EXPECT_EQ(unseen.value(1, 0), 1);
}

TEST(GltfWriter, AllAttributesAndMorphTargetsAreGatheredInTheirOwnTypes) {
  GltfMaker maker = squareMaker();
  const std::uint32_t color = maker.accessor<std::uint8_t>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 5121, "VEC3");
  maker.json["accessors"][color]["normalized"] = true;
  maker.json["accessors"][color]["name"] = "colours";
  squarePrimitive(maker)["attributes"]["COLOR_0"] = color;
  squarePrimitive(maker)["targets"] =
      Json::array({{{"POSITION", maker.floats({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4}, "VEC3")}}});
  const Scene again = roundTrip(maker.read());
  const Json& primitive = again.source->json["meshes"][0]["primitives"][0];
  const Accessor colors(*again.source, primitive["attributes"]["COLOR_0"].get<std::uint32_t>());
  const Accessor heights(*again.source, primitive["targets"][0]["POSITION"].get<std::uint32_t>());
  EXPECT_TRUE(colors.layout().normalized);
  EXPECT_EQ(colors.layout().componentType, 5121u);
  ASSERT_EQ(colors.count(), 6u);
  // New vertices 3, 4, 5 are the corners 0, 2, 3 of the second triangle.
  EXPECT_EQ(colors.rawValue(5, 2), 11);
  EXPECT_EQ(heights.value(4, 2), 3);
}

TEST(GltfWriter, TexturesOnTheSecondSetKeepTheirCoordinates) {
  GltfMaker maker = squareMaker();
  const std::vector<std::uint8_t> png = storedPng({1, 1, {9, 8, 7, 255}});
  maker.json["images"] = Json::array({{{"uri", "data:image/png;base64," + test::base64(png)}}});
  maker.json["textures"] = Json::array({{{"source", 0}}});
  const Json use = {
      {"index", 0}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}, {"scale", {2, 2}}}}}}};
  maker.json["materials"] = Json::array(
      {{{"pbrMetallicRoughness", {{"baseColorTexture", use}}}, {"occlusionTexture", {{"index", 0}, {"texCoord", 1}}}}});
  squarePrimitive(maker)["material"] = 0;
  squarePrimitive(maker)["attributes"]["TEXCOORD_0"] = maker.floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  squarePrimitive(maker)["attributes"]["TEXCOORD_1"] = maker.floats({5, 5, 6, 5, 6, 6, 5, 6}, "VEC2");
  const Scene scene = maker.read();
  const Scene again = roundTrip(scene);
  EXPECT_EQ(again.materials[0].baseColorTexture.uvSet, 1);
  EXPECT_EQ(again.materials[0].baseColorTexture.rowU, scene.materials[0].baseColorTexture.rowU);
  for (std::uint32_t t = 0; t < 2; ++t) {
    for (const int k : {0, 1, 2}) EXPECT_EQ(again.uv1[again.triangles[t].v[k]], scene.uv1[scene.triangles[t].v[k]]);
  }
  EXPECT_EQ(again.source->json["materials"][0]["occlusionTexture"]["texCoord"], 2);
  EXPECT_TRUE(attributesOf(again).contains("TEXCOORD_2"));
  EXPECT_EQ(again.images[0].rgba, (std::vector<std::uint8_t>{9, 8, 7, 255}));
  EXPECT_FALSE(again.source->json["images"][0].contains("uri"));
  EXPECT_EQ(again.source->json["images"][0]["mimeType"], "image/png");
}

TEST(GltfWriter, EmissiveFactorsOverOneMoveIntoTheStrengthBitForBit) {
  GltfMaker maker = squareMaker();
  maker.json["materials"] = Json::array({{{"emissiveFactor", {10, 7.3, 0.1}}}});
  squarePrimitive(maker)["material"] = 0;
  const Scene scene = maker.read();
  const Scene again = roundTrip(scene);
  EXPECT_EQ(again.materials[0].emissive, scene.materials[0].emissive);
  const Json& json = again.source->json;
  for (const Json& f : json["materials"][0]["emissiveFactor"]) EXPECT_LE(f.get<double>(), 1);
  EXPECT_EQ(json["extensionsUsed"], Json::array({"KHR_materials_emissive_strength"}));
}

TEST(GltfWriter, OldGeometryIsNotCarriedAlong) {
  const Scene scene = squareMaker().read();
  const Scene again = readGlb(writeSceneGlb(scene, someAtlas(scene)), "again.glb");
  // Indices, positions, atlas, charts; the zero set has no data.
  EXPECT_EQ(again.source->json["bufferViews"].size(), 4u);
  EXPECT_EQ(again.source->json["accessors"].size(), 5u);
}

TEST(GltfWriter, ScenesMadeInMemoryCanBeWrittenAndRead) {
  test::SceneBuilder builder;
  Material textured = test::diffuseMaterial({0.5f, 0.25f, 1}, {3, 2, 1});
  textured.emissiveTexture.texture = 0;
  textured.emissiveTexture.offset = {0.5f, 0};
  builder.addDiffuse({0.25f, 0.5f, 0.75f});
  builder.addMaterial(textured);
  builder.addBox({0, 0, 0}, {4, 2, 1}, 0, true);
  builder.addQuad({1, 0.5, 0.5}, {2, 0.5, 0.5}, {2, 1, 0.5}, {1, 1, 0.5}, 1);
  builder.addLight({.name = "lamp",
                    .kind = LightKind::spot,
                    .intensity = {4, 2, 1},
                    .position = {1, 1, 0.5},
                    .direction = {0, -1, 0}});
  builder.addCamera({3, 1, 0.5}, {0, 1, 0.5});
  Scene scene = builder.build();
  scene.textures.push_back({.image = 0, .wrapS = Wrap::clampToEdge});
  scene.images.push_back({2, 1, {1, 2, 3, 255, 4, 5, 6, 255}});
  const AtlasUv uv = someAtlas(scene);
  const Scene again = readGlb(writeSceneGlb(scene, uv), "memory.glb");
  expectSame(scene, again, uv);  // a box around exact numbers: nothing is rounded on the way
  EXPECT_EQ(again.materials[1].emissive, textured.emissive);
  EXPECT_EQ(again.materials[1].emissiveTexture.offset, textured.emissiveTexture.offset);
  EXPECT_EQ(again.materials[0].specular, 0);
  EXPECT_EQ(again.images[0].rgba, scene.images[0].rgba);
  EXPECT_EQ(again.textures[0].wrapS, Wrap::clampToEdge);
  ASSERT_EQ(again.lights.size(), 1u);
  EXPECT_EQ(again.lights[0].intensity, (Rgb{4, 2, 1}));
  EXPECT_NEAR(again.lights[0].direction.y, -1, 1e-12);
  EXPECT_NEAR(again.lights[0].cosOuter, scene.lights[0].cosOuter, 1e-12);
  ASSERT_EQ(again.cameras.size(), 1u);
  EXPECT_NEAR(again.cameras[0].back.x, 1, 1e-12);
}

TEST(GltfWriter, MaterialsMadeInMemoryKeepAlphaMapsAndGlass) {
  Material m = test::diffuseMaterial({0.5f, 0.25f, 1});
  m.alphaMode = AlphaMode::mask;
  m.alpha = 0.75f;
  m.alphaCutoff = 0.25f;
  m.transmission = 0.5f;
  m.solid = true;
  m.attenuationColor = {1, 0.5f, 0};
  m.attenuationDistance = 3;
  m.normalScale = 0.5f;
  for (TextureUse* use : {&m.normalTexture, &m.specularTexture, &m.specularColorTexture, &m.transmissionTexture})
    use->texture = 0;
  test::SceneBuilder builder;
  builder.addMaterial(m);
  m = test::diffuseMaterial(Rgb{1.f}, Rgb{1.f});
  m.unlit = true;
  builder.addMaterial(m);
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  builder.addQuad({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, 1);
  Scene scene = builder.build();
  scene.textures.push_back({.image = 0});
  scene.images.push_back({1, 1, {128, 128, 255, 255}});
  scene.tangents.assign(scene.positions.size(), {0.6f, 0.8f, 0, -1});  // not those of the texture coordinates
  const Scene again = readGlb(writeSceneGlb(scene, someAtlas(scene)), "memory.glb");
  const Material &a = again.materials[0], &b = scene.materials[0];
  EXPECT_EQ(a.alphaMode, b.alphaMode);
  EXPECT_EQ(a.alpha, b.alpha);
  EXPECT_EQ(a.alphaCutoff, b.alphaCutoff);
  EXPECT_EQ(a.transmission, b.transmission);
  EXPECT_TRUE(a.solid);
  EXPECT_EQ(a.attenuationColor, b.attenuationColor);
  EXPECT_EQ(a.attenuationDistance, b.attenuationDistance);
  EXPECT_EQ(a.normalScale, b.normalScale);
  EXPECT_TRUE(a.normalTexture && a.specularTexture && a.specularColorTexture && a.transmissionTexture);
  EXPECT_TRUE(again.materials[1].unlit);
  EXPECT_EQ(again.materials[1].emissive, Rgb{1.f});
  const Vec4f t = again.tangents[again.triangles[0].v[0]];
  EXPECT_NEAR(t.x, 0.6, 1e-6);
  EXPECT_NEAR(t.y, 0.8, 1e-6);
  EXPECT_EQ(t.w, -1);
}

TEST(GltfWriter, ForeignChartAttributesAreIgnoredAndSaid) {
  GltfMaker maker = squareMaker();
  squarePrimitive(maker)["attributes"]["_CHART"] = maker.floats({0, 1, 2, 3}, "SCALAR");
  const Scene scene = maker.read();
  EXPECT_TRUE(scene.chartOfTriangle.empty());
  EXPECT_THAT(scene.leftOut, ::testing::Contains(::testing::HasSubstr("_CHART")));
  GltfMaker ours = squareMaker();
  squarePrimitive(ours)["attributes"]["_CHART"] = ours.floats({7, 7, 7, 7}, "SCALAR");
  EXPECT_THAT(ours.read().chartOfTriangle, ::testing::ElementsAre(7u, 7u));
}

TEST(GltfWriter, AtlasOfAnotherSceneIsABrokenContract) {
  const Scene scene = squareMaker().read();
  EXPECT_THROW(writeSceneGlb(scene, {}), std::logic_error);
}

}  // namespace
}  // namespace lucarne::gltf_writer_test
