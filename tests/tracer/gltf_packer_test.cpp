// A packed scene is the scene: every bit of it, wherever its files lie, and packing it again changes nothing.
#include "tracer/scene/gltf_packer.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.h"
#include "tests/base/temp_folder.h"
#include "tests/tracer/gltf_files.h"
#include "tests/tracer/gltf_maker.h"

namespace lucarne::gltf_packer_test {
namespace {

namespace fs = std::filesystem;

using test::gltfFilesBelow;
using test::kAssets;

bool sameUse(const TextureUse& a, const TextureUse& b) {
  return a.texture == b.texture && a.uvSet == b.uvSet && a.rowU == b.rowU && a.rowV == b.rowV && a.offset == b.offset;
}

bool sameTextures(const Material& a, const Material& b) {
  return sameUse(a.baseColorTexture, b.baseColorTexture) && sameUse(a.emissiveTexture, b.emissiveTexture) &&
         sameUse(a.metallicRoughnessTexture, b.metallicRoughnessTexture) && sameUse(a.normalTexture, b.normalTexture) &&
         sameUse(a.specularTexture, b.specularTexture) && sameUse(a.specularColorTexture, b.specularColorTexture) &&
         sameUse(a.transmissionTexture, b.transmissionTexture);
}

bool sameMaterial(const Material& a, const Material& b) {
  return a.name == b.name && sameTextures(a, b) && a.baseColor == b.baseColor && a.alphaMode == b.alphaMode &&
         a.alpha == b.alpha && a.alphaCutoff == b.alphaCutoff && a.unlit == b.unlit && a.metallic == b.metallic &&
         a.roughness == b.roughness && a.emissive == b.emissive && a.normalScale == b.normalScale &&
         a.specular == b.specular && a.specularColor == b.specularColor && a.ior == b.ior &&
         a.transmission == b.transmission && a.solid == b.solid && a.attenuationColor == b.attenuationColor &&
         a.attenuationDistance == b.attenuationDistance && a.doubleSided == b.doubleSided;
}

bool sameLight(const Light& a, const Light& b) {
  return a.name == b.name && a.kind == b.kind && a.intensity == b.intensity && a.position == b.position &&
         a.direction == b.direction && a.cosInner == b.cosInner && a.cosOuter == b.cosOuter;
}

bool sameCamera(const Camera& a, const Camera& b) {
  return a.name == b.name && a.position == b.position && a.right == b.right && a.up == b.up && a.back == b.back &&
         a.yfov == b.yfov;
}

bool sameTriangle(const Triangle& a, const Triangle& b) {
  return std::ranges::equal(a.v, b.v) && a.material == b.material;
}

bool sameTexture(const Texture& a, const Texture& b) {
  return a.image == b.image && a.wrapS == b.wrapS && a.wrapT == b.wrapT && a.nearest == b.nearest;
}

bool sameImage(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.rgba == b.rgba;
}

void expectSameScene(const Scene& a, const Scene& b) {
  EXPECT_TRUE(a.frame.origin == b.frame.origin && a.frame.scale == b.frame.scale);
  EXPECT_TRUE(a.positions == b.positions);
  EXPECT_TRUE(a.normals == b.normals);
  EXPECT_TRUE(a.uv0 == b.uv0);
  EXPECT_TRUE(a.uv1 == b.uv1);
  EXPECT_TRUE(a.atlasUv == b.atlasUv);
  EXPECT_TRUE(a.tangents == b.tangents);
  EXPECT_EQ(a.smooth, b.smooth);
  EXPECT_EQ(a.skipped, b.skipped);
  EXPECT_TRUE(std::ranges::equal(a.triangles, b.triangles, sameTriangle));
  EXPECT_TRUE(std::ranges::equal(a.materials, b.materials, sameMaterial));
  EXPECT_TRUE(std::ranges::equal(a.textures, b.textures, sameTexture));
  EXPECT_TRUE(std::ranges::equal(a.images, b.images, sameImage));
  EXPECT_TRUE(std::ranges::equal(a.lights, b.lights, sameLight));
  EXPECT_TRUE(std::ranges::equal(a.cameras, b.cameras, sameCamera));
  EXPECT_EQ(a.leftOut, b.leftOut);
}

/// Packing `file` keeps its scene, and packing that again gives the same bytes.
void expectPacksWhole(const fs::path& file) {
  SCOPED_TRACE(file);
  const PackedScene packed = readPacked(file);
  expectSameScene(packed.scene, readGltf(file));
  EXPECT_TRUE(packGltf(*loadGltfSource(packed.glb, "packed")) == packed.glb);
}

std::vector<std::uint8_t> packedBytes(const fs::path& file) { return packGltf(*loadGltfSource(file)); }

TEST(GltfPacker, ScenesThatShipAreKeptBitForBit) {
  const std::set<fs::path> files = gltfFilesBelow(LUCARNE_SOURCE_DIR "/scenes");
  EXPECT_GE(files.size(), 3u);
  for (const fs::path& file : files) expectPacksWhole(file);
}

TEST(GltfPacker, ScenesOfOthersAreKeptBitForBit) {
  if (!fs::exists(kAssets / "scenes")) GTEST_SKIP() << "no folder " << kAssets / "scenes";
  for (const fs::path& file : gltfFilesBelow(kAssets / "scenes")) expectPacksWhole(file);
}

TEST(GltfPacker, ModelsOfOthersAreKeptBitForBit) {
  if (!fs::exists(kAssets / "models")) GTEST_SKIP() << "no folder " << kAssets / "models";
  for (const fs::path& file : gltfFilesBelow(kAssets / "models")) expectPacksWhole(file);
}

TEST(GltfPacker, MalformedFilesAreRefusedAsTheReaderRefusesThem) {
  if (!fs::exists(kAssets / "malformed")) GTEST_SKIP() << "no folder " << kAssets / "malformed";
  for (const fs::path& file : gltfFilesBelow(kAssets / "malformed")) {
    const auto outcome = [&](const auto& read) -> std::string {
      try {
        read();
        return "";
      } catch (const InputError& error) {
        return error.what();
      }
    };
    EXPECT_EQ(outcome([&] { readPacked(file); }), outcome([&] { readGltf(file); })) << file;
  }
}

/// A .gltf with its buffer and its image in files of their own.
class SplitGltf : public ::testing::Test {
 protected:
  static fs::path write(const fs::path& folder, const std::string& buffer = "data.bin") {
    fs::create_directories(folder);
    test::GltfMaker maker = test::squareMaker();
    const std::uint32_t uv = maker.floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
    test::squarePrimitive(maker)["attributes"]["TEXCOORD_0"] = uv;
    test::squarePrimitive(maker)["material"] = 0;
    test::Json whole = maker.json;
    whole["buffers"] = test::Json::array({{{"byteLength", maker.bytes.size()}, {"uri", buffer}}});
    whole["images"] = test::Json::array({{{"uri", "picture.png"}}});
    whole["textures"] = test::Json::array({{{"source", 0}}});
    whole["materials"] = test::Json::array(
        {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"extras", {{"mine", 7}}}}});
    whole["extras"] = {{"note", "kept"}};
    std::ofstream(folder / "scene.gltf") << whole.dump();
    std::ofstream(folder / buffer, std::ios::binary)
        .write(reinterpret_cast<const char*>(maker.bytes.data()), static_cast<std::streamsize>(maker.bytes.size()));
    return folder / "scene.gltf";
  }
  /// 1 × 1, grey 8 bit.
  static void writePicture(const fs::path& folder) {
    constexpr unsigned char png[] = {0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,    0,    13,   'I',  'H',
                                     'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,
                                     0,    0x3a, 0x7e, 0x9b, 0x55, 0,    0,    0,    10,   'I',  'D',  'A',  'T',  0x78,
                                     0x9c, 0x63, 0x68, 0,    0,    0,    0x82, 0,    0x81, 0x77, 0xcd, 0x72, 0xb6, 0,
                                     0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
    std::ofstream(folder / "picture.png", std::ios::binary).write(reinterpret_cast<const char*>(png), sizeof(png));
  }
  TempFolder temp_;
};

TEST_F(SplitGltf, PacksToTheSameBytesWhereverItLies) {
  const fs::path here = write(temp_ / "here"), there = write(temp_ / "deep inside");
  for (const fs::path& file : {here, there}) writePicture(file.parent_path());
  const std::vector<std::uint8_t> packed = packedBytes(here);
  EXPECT_TRUE(packed == packedBytes(there));
  const fs::path before = fs::current_path();
  fs::current_path(temp_ / "here");
  EXPECT_TRUE(packed == packedBytes("scene.gltf"));
  fs::current_path(before);
}

TEST_F(SplitGltf, PacksWithItsImageAndAllThatItSaysOfItself) {
  const fs::path file = write(temp_ / "a");
  writePicture(temp_ / "a");
  expectPacksWhole(file);
  const PackedScene packed = readPacked(file);
  ASSERT_EQ(packed.scene.images.size(), 1u);
  EXPECT_EQ(packed.scene.images[0].width, 1);
  const auto source = loadGltfSource(packed.glb, "packed");
  EXPECT_EQ(source->json["extras"]["note"], "kept");
  EXPECT_EQ(source->json["materials"][0]["extras"]["mine"], 7);
  EXPECT_FALSE(source->json["buffers"][0].contains("uri"));
  EXPECT_FALSE(source->json["images"][0].contains("uri"));
}

TEST_F(SplitGltf, AMissingImageStaysMissing) {
  const fs::path file = write(temp_ / "a");
  expectPacksWhole(file);
  EXPECT_EQ(loadGltfSource(readPacked(file).glb, "packed")->json["images"][0]["uri"], "picture.png");
}

TEST_F(SplitGltf, ABufferThatIsMissingIsNamed) {
  const fs::path file = write(temp_ / "a");
  fs::remove(temp_ / "a" / "data.bin");
  try {
    readPacked(file);
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("data.bin"));
  }
}

TEST_F(SplitGltf, CornellBoxOfOthersPacksToTheSameBytesElsewhere) {
  const fs::path folder = kAssets / "scenes" / "cornell_nv";
  if (!fs::exists(folder)) GTEST_SKIP() << "no folder " << folder;
  fs::copy(folder, temp_ / "copy", fs::copy_options::recursive);
  EXPECT_TRUE(packedBytes(folder / "cornellBox.gltf") == packedBytes(temp_ / "copy" / "cornellBox.gltf"));
}

TEST(GltfPacker, AGlbAndAGltfOfOneDocumentPackAlike) {
  const test::GltfMaker maker = test::squareMaker();
  const std::string text = maker.text();
  const auto fromText =
      loadGltfSource(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "a.gltf");
  EXPECT_TRUE(packGltf(*fromText) == packGltf(*loadGltfSource(maker.glb(), "a.glb")));
}

}  // namespace
}  // namespace lucarne::gltf_packer_test
