#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tracer/gltf_maker.h"

namespace lucarne::gltf_materials_test {
namespace {

using test::GltfMaker;
using test::squareMaker;
using test::squarePrimitive;
using test::squareWith;
using test::withTexture;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(GltfMaterials, DefaultsAreThoseOfTheSpecification) {
  const Scene scene = squareWith(Json::object()).read();
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.baseColor, Rgb{1.f});
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.emissive, Rgb{0.f});
  EXPECT_EQ(m.specular, 1);
  EXPECT_EQ(m.specularColor, Rgb{1.f});
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_FALSE(m.doubleSided);
  EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
  EXPECT_EQ(m.alpha, 1);
  EXPECT_EQ(m.alphaCutoff, 0.5f);
  EXPECT_FALSE(m.unlit || m.transmits() || m.solid || m.normalTexture);
  EXPECT_TRUE(scene.tangents.empty());
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(GltfMaterials, FactorsAndExtensionsAreRead) {
  const Scene scene =
      squareWith({{"name", "m"},
                  {"doubleSided", true},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.6}}},
                  {"emissiveFactor", {2, 0.5, 0}},
                  {"extensions",
                   {{"KHR_materials_emissive_strength", {{"emissiveStrength", 100}}},
                    {"KHR_materials_specular", {{"specularFactor", 0.25}, {"specularColorFactor", {1, 2, 0.5}}}},
                    {"KHR_materials_ior", {{"ior", 1.25}}}}}})
          .read();
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.name, "m");
  EXPECT_TRUE(m.doubleSided);
  EXPECT_EQ(m.baseColor, (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(m.alpha, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_EQ(m.emissive, (Rgb{200, 50, 0}));
  EXPECT_EQ(m.specular, 0.25f);
  EXPECT_EQ(m.specularColor, (Rgb{1, 2, 0.5f}));
  EXPECT_EQ(m.ior, 1.25f);
  EXPECT_THAT(scene.leftOut, IsEmpty());
}

TEST(GltfMaterials, PrimitivesWithoutMaterialGetADefaultBehindTheOthers) {
  GltfMaker maker = squareWith({{"name", "red"}});
  Json bare = squarePrimitive(maker);
  bare.erase("material");
  maker.json["meshes"][0]["primitives"].push_back(bare);
  const Scene scene = maker.read();
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.triangles[0].material, 0u);
  EXPECT_EQ(scene.triangles[2].material, 1u);
}

TEST(GltfMaterials, FactorsOutsideTheirRangeAreBroughtIntoItAndSaid) {
  const Scene scene =
      squareWith({{"pbrMetallicRoughness", {{"baseColorFactor", {1.5, -1, 0.5, 1}}, {"roughnessFactor", 7}}}}).read();
  EXPECT_EQ(scene.materials[0].baseColor, (Rgb{1, 0, 0.5f}));
  EXPECT_EQ(scene.materials[0].roughness, 1);
  EXPECT_THAT(scene.leftOut, Contains("material factors outside their range: brought into it"));
}

TEST(GltfMaterials, LightThatCannotBeIsRefused) {
  EXPECT_THAT(test::complaint(squareWith({{"emissiveFactor", {-1, 0, 0}}})),
              HasSubstr("materials[0].emissiveFactor: is negative"));
  EXPECT_THAT(test::complaint(squareWith({{"emissiveFactor", {1e300, 0, 0}}})), HasSubstr("too large"));
  EXPECT_THAT(test::complaint(squareWith({{"emissiveFactor", {1, 0}}})), HasSubstr("has 2 numbers, not 3"));
  EXPECT_THAT(test::complaint(squareWith({{"emissiveFactor", "red"}})), HasSubstr("is not an array"));
}

TEST(GltfMaterials, TexturesSamplersAndImagesAreRead) {
  GltfMaker maker = withTexture(squareWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}));
  maker.json["textures"][0]["sampler"] = 0;
  maker.json["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
  const Scene scene = maker.read();
  ASSERT_TRUE(scene.materials[0].baseColorTexture);
  const Texture& texture = scene.textures[0];
  EXPECT_EQ(texture.wrapS, Wrap::clampToEdge);
  EXPECT_EQ(texture.wrapT, Wrap::mirroredRepeat);
  EXPECT_TRUE(texture.nearest);
  ASSERT_EQ(scene.images[texture.image].width, 2);
  EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255}));
}

TEST(GltfMaterials, BrokenForeignAndMissingImagesAreWhiteAndNamed) {
  const Json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
  GltfMaker webp = withTexture(squareWith(material));
  webp.json["images"][0]["uri"] =
      "data:image/webp;base64," + test::base64({'R', 'I', 'F', 'F', 0, 0, 0, 0, 'W', 'E', 'B', 'P'});
  GltfMaker missing = withTexture(squareWith(material));
  missing.json["images"][0]["uri"] = "not%20there.png";
  GltfMaker dangling = withTexture(squareWith(material));
  dangling.json["textures"][0]["source"] = 7;
  for (const GltfMaker& maker : {webp, missing, dangling}) {
    const Scene scene = maker.read();
    ASSERT_EQ(scene.leftOut.size(), 1u);
    EXPECT_THAT(scene.leftOut[0], HasSubstr("white"));
    EXPECT_EQ(scene.images[0].rgba, (std::vector<std::uint8_t>{255, 255, 255, 255}));
  }
  EXPECT_THAT(webp.read().leftOut[0], HasSubstr("image colours"));
}

TEST(GltfMaterials, TextureTransformTurnsCounterClockwiseAsSeen) {
  const double quarter = 1.5707963267948966;
  const Json info = {{"index", 0},
                     {"extensions",
                      {{"KHR_texture_transform",
                        {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", quarter}, {"texCoord", 1}}}}}};
  const Scene scene = withTexture(squareWith({{"emissiveTexture", info}, {"emissiveFactor", {1, 1, 1}}})).read();
  const TextureUse& use = scene.materials[0].emissiveTexture;
  EXPECT_EQ(use.uvSet, 1);
  // (u, v) → (2u, 3v) → a quarter turn that takes +u to −v (up in the image) → offset.
  const auto apply = [&](Vec2f uv) { return Vec2f{dot(use.rowU, uv), dot(use.rowV, uv)} + use.offset; };
  EXPECT_NEAR(apply({1, 0}).x, 0.5, 1e-6);
  EXPECT_NEAR(apply({1, 0}).y, 0.25 - 2, 1e-6);
  EXPECT_NEAR(apply({0, 1}).x, 0.5 + 3, 1e-6);
  EXPECT_NEAR(apply({0, 1}).y, 0.25, 1e-6);
}

TEST(GltfMaterials, SecondTextureSetIsTheOneThatTheMaterialUses) {
  GltfMaker maker =
      withTexture(squareWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 3}}}}}}));
  squarePrimitive(maker)["attributes"]["TEXCOORD_1"] = maker.floats({1, 1, 1, 1, 1, 1, 1, 1}, "VEC2");
  squarePrimitive(maker)["attributes"]["TEXCOORD_3"] = maker.floats({3, 3, 3, 3, 3, 3, 3, 3}, "VEC2");
  const Scene scene = maker.read();
  EXPECT_EQ(scene.materials[0].baseColorTexture.uvSet, 1);
  EXPECT_EQ(scene.uv1[0], (Vec2f{3, 3}));
  EXPECT_EQ(scene.atlasUv[0], (Vec2f{1, 1}));
  EXPECT_TRUE(scene.uv0.empty());
}

TEST(GltfMaterials, WhatIsNotModelledIsListedOnceInWords) {
  GltfMaker maker = squareWith(
      {{"occlusionTexture", {{"index", 0}}},
       {"extensions", {{"KHR_materials_dispersion", {{"dispersion", 1}}}, {"KHR_materials_unlit", Json::object()}}}});
  maker = withTexture(maker);
  maker.json["materials"].push_back({{"extensions", {{"KHR_materials_sheen", Json::object()}}}});  // used by nothing
  maker.json["materials"].push_back(
      {{"extensions",
        {{"KHR_materials_dispersion", Json::object()}, {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}});
  Json second = squarePrimitive(maker);
  second["material"] = 2;
  maker.json["meshes"][0]["primitives"].push_back(second);
  maker.json["extensionsUsed"] = {"KHR_materials_dispersion", "KHR_materials_unlit", "KHR_materials_volume",
                                  "KHR_materials_sheen", "ACME_wobble"};
  EXPECT_THAT(maker.read().leftOut, ElementsAre("occlusion maps of 1 material: ignored, light is computed instead",
                                                "volume without transmission of 1 material: ignored",
                                                "2 duplicate triangles: skipped", "dispersion of 2 materials: ignored",
                                                "unlit shading of 1 material: takes no light and gives none",
                                                "extension ACME_wobble: ignored"));
}

TEST(GltfMaterials, SpecularGlossinessBecomesDiffuseColourAndReflectance) {
  GltfMaker maker = squareWith({{"extensions",
                                 {{"KHR_materials_pbrSpecularGlossiness",
                                   {{"diffuseFactor", {0.5, 0.25, 0, 0.125}},
                                    {"specularFactor", {0.04, 0.04, 0.08}},
                                    {"glossinessFactor", 0.75}}}}}});
  maker.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
  const Scene scene = maker.read();
  EXPECT_EQ(scene.materials[0].baseColor, (Rgb{0.5f, 0.25f, 0}));
  EXPECT_EQ(scene.materials[0].metallic, 0);
  EXPECT_EQ(scene.materials[0].alpha, 0.125f);
  EXPECT_EQ(scene.materials[0].roughness, 0.25f);
  EXPECT_NEAR(scene.materials[0].specularColor.z, 2, 1e-6);
  EXPECT_THAT(scene.leftOut, Contains(HasSubstr("specular-glossiness of 1 material")));
}

TEST(GltfMaterials, RequiredExtensionsAreKnownOrRefused) {
  for (const char* name : {"KHR_texture_transform", "KHR_lights_punctual", "EXT_texture_webp", "KHR_materials_unlit"}) {
    GltfMaker maker = squareMaker();
    maker.json["extensionsRequired"] = {name};
    EXPECT_EQ(test::complaint(maker), "") << name;
  }
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_wobble"}) {
    GltfMaker maker = squareMaker();
    maker.json["extensionsRequired"] = {name};
    EXPECT_THAT(test::complaint(maker), HasSubstr(name));
    EXPECT_THAT(test::complaint(maker), HasSubstr("export it without"));
  }
}

}  // namespace
}  // namespace lucarne::gltf_materials_test
