// Alpha, normal maps and the material extensions that the tracer models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tracer/gltf_maker.h"

namespace lucarne::gltf_material_extensions_test {
namespace {

using test::GltfMaker;
using test::squarePrimitive;
using test::squareWith;
using test::withTexture;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kClamped = "material factors outside their range: brought into it";

Material read(const Json& material) { return withTexture(squareWith(material)).read().materials[0]; }

Json extension(const char* name, const Json& value) { return {{"extensions", {{name, value}}}}; }

/// A transmitting material with a volume.
Json glass(const Json& volume, double transmission = 1) {
  return {{"extensions",
           {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}}, {"KHR_materials_volume", volume}}}};
}

TEST(GltfAlpha, ModesFactorAndCutoffAreRead) {
  const Json pbr = {{"baseColorFactor", {1, 1, 1, 0.25}}};
  const Material mask = read({{"alphaMode", "MASK"}, {"alphaCutoff", 0.75}, {"pbrMetallicRoughness", pbr}});
  EXPECT_EQ(mask.alphaMode, AlphaMode::mask);
  EXPECT_EQ(mask.alphaCutoff, 0.75f);
  EXPECT_EQ(mask.alpha, 0.25f);
  EXPECT_TRUE(mask.hasAlpha());
  EXPECT_EQ(read({{"alphaMode", "BLEND"}}).alphaMode, AlphaMode::blend);
  EXPECT_EQ(read({{"alphaMode", "OPAQUE"}}).alphaMode, AlphaMode::opaque);
  EXPECT_THAT(test::complaint(squareWith({{"alphaMode", "FOG"}})), HasSubstr("materials[0].alphaMode: is none of"));
  EXPECT_THAT(test::complaint(squareWith({{"alphaMode", 1}})), HasSubstr("is not a string"));
}

TEST(GltfAlpha, CutoffAboveOneIsLegalAndBelowZeroIsNot) {
  const Scene all = squareWith({{"alphaMode", "MASK"}, {"alphaCutoff", 1e40}}).read();
  EXPECT_GT(all.materials[0].alphaCutoff, 1);
  EXPECT_THAT(all.leftOut, IsEmpty());
  const Scene none = squareWith({{"alphaMode", "MASK"}, {"alphaCutoff", -1}}).read();
  EXPECT_EQ(none.materials[0].alphaCutoff, 0);
  EXPECT_THAT(none.leftOut, Contains(kClamped));
}

TEST(GltfNormalMap, TextureTransformSetAndScaleAreRead) {
  const Json use = {{"index", 0},
                    {"scale", -0.5},
                    {"texCoord", 2},
                    {"extensions", {{"KHR_texture_transform", {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}}}}}};
  GltfMaker maker = withTexture(squareWith({{"normalTexture", use}}));
  squarePrimitive(maker)["attributes"]["TEXCOORD_2"] = maker.floats({2, 2, 3, 2, 3, 3, 2, 3}, "VEC2");
  const Scene scene = maker.read();
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.normalScale, -0.5f);
  EXPECT_EQ(m.normalTexture.texture, 0u);
  EXPECT_EQ(m.normalTexture.uvSet, 1);
  EXPECT_EQ(m.normalTexture.rowU, (Vec2f{2, 0}));
  EXPECT_EQ(m.normalTexture.rowV, (Vec2f{0, 3}));
  EXPECT_EQ(m.normalTexture.offset, (Vec2f{0.25f, 0.5f}));
  EXPECT_EQ(scene.uv1[0], (Vec2f{2, 2}));
  EXPECT_EQ(scene.images[0].width, 2);  // decoded, though only the normal map uses it
  EXPECT_THAT(scene.leftOut, IsEmpty());
}

TEST(GltfNormalMap, HugeScalesAreBroughtIntoRange) {
  const Scene scene = withTexture(squareWith({{"normalTexture", {{"index", 0}, {"scale", -1e300}}}})).read();
  EXPECT_EQ(scene.materials[0].normalScale, -1e6f);
  EXPECT_THAT(scene.leftOut, Contains(kClamped));
}

TEST(GltfNormalMap, WithoutAnImageThereIsNoneForWhiteIsNoNormal) {
  const Json use = {{"index", 0}};
  const Json material = {{"normalTexture", use}, {"pbrMetallicRoughness", {{"baseColorTexture", use}}}};
  GltfMaker dangling = withTexture(squareWith(material)), broken = dangling;
  dangling.json["textures"][0].erase("source");
  const Scene a = dangling.read();
  EXPECT_FALSE(a.materials[0].normalTexture);
  EXPECT_TRUE(a.materials[0].baseColorTexture);
  EXPECT_TRUE(a.tangents.empty());
  EXPECT_THAT(a.leftOut, Contains("normal maps without a PNG or JPEG image: ignored"));
  EXPECT_THAT(a.leftOut, Contains("textures without a PNG or JPEG image: white stands in"));
  broken.json["images"][0]["uri"] = "data:image/png;base64,AAAA";
  const Scene b = broken.read();
  EXPECT_FALSE(b.materials[0].normalTexture);
  EXPECT_TRUE(b.materials[0].baseColorTexture);
  EXPECT_TRUE(b.tangents.empty());
  EXPECT_THAT(b.leftOut, Contains("normal maps of image colours: ignored"));
}

TEST(GltfSpecular, BothTexturesAreRead) {
  const Json uses = {{"specularTexture", {{"index", 0}, {"texCoord", 1}}}, {"specularColorTexture", {{"index", 0}}}};
  const Material m = read(extension("KHR_materials_specular", uses));
  EXPECT_EQ(m.specularTexture.texture, 0u);
  EXPECT_EQ(m.specularTexture.uvSet, 1);
  EXPECT_EQ(m.specularColorTexture.texture, 0u);
  EXPECT_EQ(m.specularColorTexture.uvSet, 0);
}

TEST(GltfTransmission, FactorAndTextureAreRead) {
  const Material m = read(
      extension("KHR_materials_transmission", {{"transmissionFactor", 0.75}, {"transmissionTexture", {{"index", 0}}}}));
  EXPECT_EQ(m.transmission, 0.75f);
  EXPECT_TRUE(m.transmissionTexture);
  EXPECT_TRUE(m.transmits());
  EXPECT_FALSE(m.solid);
  EXPECT_FALSE(read(extension("KHR_materials_transmission", Json::object())).transmits());
  const Scene much = squareWith(extension("KHR_materials_transmission", {{"transmissionFactor", 3}})).read();
  EXPECT_EQ(much.materials[0].transmission, 1);
  EXPECT_THAT(much.leftOut, Contains(kClamped));
}

TEST(GltfTransmission, TexturesWithoutImageAreNamedWhereverTheyAreUsed) {
  for (const char* key : {"specularTexture", "specularColorTexture"}) {
    GltfMaker maker = withTexture(squareWith(extension("KHR_materials_specular", {{key, {{"index", 0}}}})));
    maker.json["textures"][0].erase("source");
    EXPECT_THAT(maker.read().leftOut, Contains(HasSubstr("white stands in"))) << key;
  }
  GltfMaker maker =
      withTexture(squareWith(extension("KHR_materials_transmission", {{"transmissionTexture", {{"index", 0}}}})));
  maker.json["textures"][0].erase("source");
  EXPECT_THAT(maker.read().leftOut, Contains(HasSubstr("white stands in")));
}

TEST(GltfVolume, ThicknessMakesASolidWithItsAttenuationInMetres) {
  GltfMaker maker =
      squareWith(glass({{"thicknessFactor", 0.1}, {"attenuationDistance", 2.5}, {"attenuationColor", {1, 0.5, 0}}}));
  maker.json["nodes"][0]["scale"] = {8, 8, 8};
  const Scene scene = maker.read();
  const Material& m = scene.materials[0];
  EXPECT_TRUE(m.solid);
  EXPECT_EQ(m.attenuationDistance, 2.5);  // of the world, whatever the node's scale
  EXPECT_EQ(m.attenuationColor, (Rgb{1, 0.5f, 0}));
  EXPECT_THAT(scene.leftOut, IsEmpty());
}

TEST(GltfVolume, WithoutThicknessOrTransmissionThereIsNone) {
  const Json volume = {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0}}};
  for (const Json& material : {glass({{"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0}}}), glass(volume, 0),
                               extension("KHR_materials_volume", volume)}) {
    const Material m = read(material);
    EXPECT_FALSE(m.solid);
    EXPECT_EQ(m.attenuationColor, Rgb{1.f});
    EXPECT_EQ(m.attenuationDistance, 0);
  }
}

TEST(GltfVolume, AbsentZeroAndHugeDistancesDoNotAttenuate) {
  EXPECT_EQ(read(glass({{"thicknessFactor", 1}})).attenuationDistance, 0);
  for (const double metres : {0.0, 1e30, 1e300, -1.0}) {
    const Scene scene = squareWith(glass({{"thicknessFactor", 1}, {"attenuationDistance", metres}})).read();
    EXPECT_EQ(scene.materials[0].attenuationDistance, 0) << metres;
    EXPECT_TRUE(scene.materials[0].solid);
    if (metres < 0) {
      EXPECT_THAT(scene.leftOut, Contains(kClamped));
    } else {
      EXPECT_THAT(scene.leftOut, Not(Contains(kClamped)));
    }
  }
  EXPECT_EQ(read(glass({{"thicknessFactor", 1}, {"attenuationDistance", 1e-300}})).attenuationDistance, 1e-30);
}

TEST(GltfVolume, ColoursOutsideTheirRangeAreBroughtIntoIt) {
  const Scene scene = squareWith(glass({{"thicknessFactor", 1}, {"attenuationColor", {-1, 7, 0.5}}})).read();
  EXPECT_EQ(scene.materials[0].attenuationColor, (Rgb{0, 1, 0.5f}));
  EXPECT_THAT(scene.leftOut, Contains(kClamped));
  const Scene negative = squareWith(glass({{"thicknessFactor", -1}})).read();
  EXPECT_FALSE(negative.materials[0].solid);
  EXPECT_THAT(negative.leftOut, Contains(kClamped));
}

TEST(GltfUnlit, GivesNoLightAndIsSaid) {
  GltfMaker maker = squareWith({{"emissiveFactor", {1, 1, 1}}, {"alphaMode", "BLEND"}});
  maker.json["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
  maker.json["extensionsUsed"] = {"KHR_materials_unlit"};
  const Scene scene = maker.read();
  EXPECT_TRUE(scene.materials[0].unlit);
  EXPECT_FALSE(scene.materials[0].emits());
  EXPECT_FALSE(scene.materials[0].hasAlpha());
  EXPECT_THAT(scene.leftOut, Contains("unlit shading of 1 material: takes no light and gives none"));
}

TEST(GltfMaterialExtensions, WrongTypesAndUnknownTexturesAreRefused) {
  const auto refused = [](const Json& material) { return test::complaint(withTexture(squareWith(material))); };
  EXPECT_THAT(refused({{"normalTexture", {{"index", 9}}}}), HasSubstr("normalTexture.index"));
  EXPECT_THAT(refused({{"normalTexture", {{"index", 0}, {"scale", "big"}}}}), HasSubstr("scale: is not a number"));
  EXPECT_THAT(refused({{"normalTexture", 3}}), HasSubstr("is not an object"));
  EXPECT_THAT(refused(extension("KHR_materials_unlit", 1)), HasSubstr("is not an object"));
  EXPECT_THAT(refused(extension("KHR_materials_transmission", {{"transmissionFactor", "all"}})),
              HasSubstr("is not a number"));
  EXPECT_THAT(refused(glass({{"attenuationColor", {1, 1}}})), HasSubstr("has 2 numbers, not 3"));
  EXPECT_THAT(refused(glass({{"attenuationDistance", nullptr}})), HasSubstr("is not a number"));
  EXPECT_THAT(refused({{"alphaCutoff", Json::array()}}), HasSubstr("is not a number"));
}

}  // namespace
}  // namespace lucarne::gltf_material_extensions_test
