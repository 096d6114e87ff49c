// Files that lie: every one gives an InputError or a scene, and nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/tracer/gltf_maker.h"
#include "tracer/scene/gltf_uri.h"

namespace lucarne::gltf_hostile_test {
namespace {

using test::complaint;
using test::GltfMaker;
using test::squareMaker;
using test::squarePrimitive;
using ::testing::HasSubstr;

/// The complaint about a square whose JSON `change` has changed.
template <class Change>
std::string after(const Change& change) {
  GltfMaker maker = squareMaker();
  change(maker.json, maker);
  return complaint(maker);
}

std::string complaintAboutText(const std::string& text) {
  try {
    readGlb(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "made.gltf");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(GltfHostile, EveryReferencePastTheEndIsNamed) {
  const auto set = [](const char* pointer, Json value) {
    return after([&](Json& json, GltfMaker&) { json[Json::json_pointer(pointer)] = std::move(value); });
  };
  EXPECT_THAT(set("/scene", 1), HasSubstr("scene: refers to number 1"));
  EXPECT_THAT(set("/scenes/0/nodes/0", 9), HasSubstr("scenes[0].nodes: refers to number 9"));
  EXPECT_THAT(set("/nodes/0/mesh", 1), HasSubstr("nodes[0].mesh"));
  EXPECT_THAT(set("/nodes/0/camera", 0), HasSubstr("nodes[0].camera"));
  EXPECT_THAT(set("/nodes/0/skin", 0), HasSubstr("nodes[0].skin"));
  EXPECT_THAT(set("/nodes/0/children", {4}), HasSubstr("nodes[0].children"));
  EXPECT_THAT(set("/nodes/0/extensions/KHR_lights_punctual/light", 0), HasSubstr("light"));
  EXPECT_THAT(set("/meshes/0/primitives/0/material", 0), HasSubstr("material"));
  EXPECT_THAT(set("/meshes/0/primitives/0/indices", 2), HasSubstr("indices"));
  EXPECT_THAT(set("/meshes/0/primitives/0/attributes/POSITION", 2), HasSubstr("POSITION"));
  EXPECT_THAT(set("/meshes/0/primitives/0/targets", Json::array({{{"POSITION", 7}}})),
              HasSubstr("targets[0].POSITION"));
  EXPECT_THAT(set("/meshes/0/primitives/0/mode", 7), HasSubstr("mode"));
  EXPECT_THAT(set("/accessors/0/bufferView", 5), HasSubstr("accessors[0].bufferView"));
  EXPECT_THAT(set("/bufferViews/0/buffer", 1), HasSubstr("bufferViews[0].buffer"));
  EXPECT_THAT(set("/textures", Json::array({{{"sampler", 0}}})), HasSubstr("textures[0].sampler"));
  EXPECT_THAT(set("/images", Json::array({{{"bufferView", 9}}})), HasSubstr("images[0].bufferView"));
  EXPECT_THAT(set("/materials", Json::array({{{"normalTexture", {{"index", 0}}}}})),
              HasSubstr("materials[0].normalTexture.index"));
  EXPECT_THAT(set("/skins", Json::array({{{"joints", {3}}}})), HasSubstr("skins[0].joints"));
  EXPECT_THAT(set("/animations", Json::array({{{"samplers", Json::array({{{"input", 8}, {"output", 0}}})}}})),
              HasSubstr("input"));
  EXPECT_THAT(set("/scene", -1), HasSubstr("scene: is not a whole number"));
  EXPECT_THAT(set("/scene", 0.5), HasSubstr("scene: is not a whole number"));
  EXPECT_THAT(set("/scene", nullptr), HasSubstr("scene: is not a whole number"));
}

TEST(GltfHostile, BoundsAreCheckedWithoutOverflow) {
  const std::uint64_t huge = 0xffffffffffffffffu;
  const auto set = [](const char* pointer, Json value) {
    return after([&](Json& json, GltfMaker&) { json[Json::json_pointer(pointer)] = std::move(value); });
  };
  for (const std::uint64_t big : {std::uint64_t{60}, std::uint64_t{1} << 32, std::uint64_t{1} << 63, huge, huge - 47}) {
    EXPECT_NE(set("/bufferViews/0/byteOffset", big), "") << big;
    EXPECT_NE(set("/bufferViews/0/byteLength", big + 4), "") << big;
    EXPECT_NE(set("/accessors/0/byteOffset", big), "") << big;
    EXPECT_NE(set("/accessors/0/count", big), "") << big;
  }
  EXPECT_THAT(set("/accessors/0/byteOffset", 4), HasSubstr("past the end of its buffer view"));
  EXPECT_THAT(set("/accessors/0/count", 0), HasSubstr("count"));
  EXPECT_THAT(set("/bufferViews/0/byteStride", 3), HasSubstr("byteStride"));
  EXPECT_THAT(set("/bufferViews/0/byteStride", 8), HasSubstr("larger than the stride"));
  EXPECT_THAT(set("/bufferViews/0/byteStride", 16), HasSubstr("past the end"));
  EXPECT_THAT(set("/accessors/0/type", "VEC5"), HasSubstr("unknown type"));
  EXPECT_THAT(set("/accessors/0/componentType", 5124), HasSubstr("unknown componentType"));
  EXPECT_THAT(set("/accessors/1/componentType", 5126), HasSubstr("accessors[1]: reaches past"));
}

TEST(GltfHostile, CountsWithoutDataBehindThemAreBounded) {
  EXPECT_THAT(after([](Json& json, GltfMaker&) {
                json["accessors"].push_back({{"componentType", 5126}, {"count", 4000000000u}, {"type", "VEC3"}});
              }),
              HasSubstr("no data for them"));
  // A mesh of four million triangles without a byte behind them, in a thousand nodes.
  EXPECT_THAT(after([](Json& json, GltfMaker& maker) {
                json["accessors"].push_back({{"componentType", 5126}, {"count", 12000000}, {"type", "VEC3"}});
                maker.mesh({{"attributes", {{"POSITION", 2}}}});
                for (int i = 0; i < 1000; ++i) maker.node({{"mesh", 1}});
              }),
              HasSubstr("triangles; simplify or split it"));
}

TEST(GltfHostile, SparseAccessorsAreChecked) {
  const auto sparse = [](std::uint64_t count, const std::vector<std::uint16_t>& indices) {
    return after([&](Json& json, GltfMaker& maker) {
      const std::uint32_t where = maker.view(indices), values = maker.view<float>({0, 0, 0, 0, 0, 0});
      json["accessors"][0]["sparse"] = {{"count", count},
                                        {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", values}}}};
    });
  };
  EXPECT_EQ(sparse(2, {1, 3}), "");
  EXPECT_THAT(sparse(2, {3, 1}), HasSubstr("do not increase"));
  EXPECT_THAT(sparse(2, {1, 1}), HasSubstr("do not increase"));
  EXPECT_THAT(sparse(2, {1, 4}), HasSubstr("past the accessor's count"));
  EXPECT_THAT(sparse(0, {1, 2}), HasSubstr("count"));
  EXPECT_THAT(sparse(3, {0, 1, 2}), HasSubstr("values: reaches past"));
  EXPECT_THAT(sparse(5, {0, 1, 2, 3, 4}), HasSubstr("count"));
}

TEST(GltfHostile, NodeGraphsThatAreNoForestAreRefused) {
  EXPECT_THAT(after([](Json& json, GltfMaker&) { json["nodes"][0]["children"] = {0}; }), HasSubstr("its own ancestor"));
  EXPECT_THAT(after([](Json& json, GltfMaker&) {
                json["nodes"].push_back({{"children", {2}}});
                json["nodes"].push_back({{"children", {1}}});
              }),
              HasSubstr("its own ancestor"));
  EXPECT_THAT(after([](Json& json, GltfMaker&) {
                json["nodes"].push_back({{"children", {2}}});
                json["nodes"].push_back(Json::object());
                json["nodes"].push_back({{"children", {2}}});
              }),
              HasSubstr("child of two nodes"));
  EXPECT_THAT(after([](Json& json, GltfMaker&) { json["scenes"][0]["nodes"] = {0, 0}; }), HasSubstr("twice"));
  EXPECT_THAT(after([](Json& json, GltfMaker&) {
                json["nodes"].push_back({{"children", {0}}});
              }),
              HasSubstr("not a root"));
}

TEST(GltfHostile, AHundredThousandNodesDeepIsNoTrouble) {
  GltfMaker maker = squareMaker();
  const int depth = 100000;
  maker.json["nodes"][0].erase("mesh");
  for (int i = 0; i < depth; ++i) {
    maker.json["nodes"][static_cast<std::size_t>(i)]["children"] = {i + 1};
    maker.json["nodes"].push_back(i + 1 == depth ? Json{{"mesh", 0}} : Json::object());
  }
  EXPECT_EQ(complaint(maker), "");
}

TEST(GltfHostile, TransformsThatCannotBeAreRefused) {
  const auto node = [](const char* key, Json value) {
    return after([&](Json& json, GltfMaker&) { json["nodes"][0][key] = std::move(value); });
  };
  EXPECT_THAT(node("rotation", {0, 0, 0, 0}), HasSubstr("nodes[0].rotation"));
  EXPECT_THAT(node("translation", {0, 0}), HasSubstr("nodes[0].translation"));
  EXPECT_THAT(node("scale", {1, "2", 3}), HasSubstr("nodes[0].scale[1]: is not a number"));
  EXPECT_THAT(node("matrix", Json::array({1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})), HasSubstr("last row"));
  std::string infinite = squareMaker().text();
  infinite.replace(infinite.find("\"mesh\":0"), 8, "\"mesh\":0,\"translation\":[1e999,0,0]");
  EXPECT_THAT(complaintAboutText(infinite), HasSubstr("made.gltf"));
}

TEST(GltfHostile, DeepAndLongJsonIsRefusedBeforeItIsParsed) {
  for (const char open : {'[', '{'}) {
    EXPECT_THAT(complaintAboutText(std::string(10000000, open)), HasSubstr("nested deeper"));
  }
  std::string nested = "{\"a\":";
  for (int i = 0; i < 10000; ++i) nested += "{\"a\":";
  EXPECT_THAT(complaintAboutText(nested), HasSubstr("nested deeper"));
  std::string wide = "[";
  for (int i = 0; i < 20000000; ++i) wide += "0,";
  EXPECT_THAT(complaintAboutText(wide), HasSubstr("values"));
}

TEST(GltfHostile, JsonOfTheWrongShapeIsRefused) {
  for (const char* text :
       {"", "[]", "1", "\"glTF\"", "{]", "{}", "{\"asset\":1}", "{\"asset\":{\"version\":\"1.0\"}}",
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":{}}", "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[1]}",
        "\xff\xfe", "{\"asset\":{\"version\":\"\xc3\x28\"}}"}) {
    EXPECT_THAT(complaintAboutText(text), HasSubstr("made.gltf: ")) << text;
  }
}

TEST(GltfHostile, UrisStayInTheFolder) {
  const Place place("f");
  const std::filesystem::path folder = "scenes";
  EXPECT_EQ(confinedPath(folder, "a/b%20c.bin", place), folder / "a/b c.bin");
  for (const char* bad : {"../x", "a/../../x", "%2e%2e/x", "/etc/passwd", "%2fetc/passwd", "file:///etc/passwd",
                          "http://a/b", "a\\b", "C:x", "", "a%0", "a%zz", "a%00b", "..", "a/.."}) {
    EXPECT_THROW(confinedPath(folder, bad, place), InputError) << bad;
  }
}

TEST(GltfHostile, DataUrisAreDecodedOrRefused) {
  const Place place("f");
  EXPECT_EQ(decodeDataUri("data:;base64,AAEC", place), (std::vector<std::uint8_t>{0, 1, 2}));
  EXPECT_EQ(decodeDataUri("data:a/b;c=d;base64,AAE=", place), (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(decodeDataUri("data:a/b;base64,/w", place), (std::vector<std::uint8_t>{255}));
  for (const char* bad :
       {"data:", "data:,AA", "data:;base64", "data:;base64,A", "data:;base64,A*AA", "data:a;;base64,AA=="}) {
    EXPECT_THROW(decodeDataUri(bad, place), InputError) << bad;
  }
}

TEST(GltfHostile, BuffersFromTheFolderAreReadAndOthersRefused) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("lucarne_gltf_folder_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "inside");
  GltfMaker maker = squareMaker();
  const auto write = [](const std::filesystem::path& path, const char* data, std::size_t size) {
    std::ofstream(path, std::ios::binary).write(data, static_cast<std::streamsize>(size));
  };
  write(folder / "data.bin", reinterpret_cast<const char*>(maker.bytes.data()), maker.bytes.size());
  const auto read = [&](const std::string& uri, const std::filesystem::path& path) -> std::string {
    Json json = maker.json;
    json["buffers"] = Json::array({{{"byteLength", maker.bytes.size()}, {"uri", uri}}});
    const std::string text = json.dump();
    write(path, text.data(), text.size());
    try {
      return std::to_string(readGltf(path).triangles.size());
    } catch (const InputError& e) {
      return e.what();
    }
  };
  EXPECT_EQ(read("data.bin", folder / "a.gltf"), "2");
  EXPECT_THAT(read("../data.bin", folder / "inside" / "a.gltf"), HasSubstr("own folder"));
  EXPECT_THAT(read("other.bin", folder / "a.gltf"), HasSubstr("other.bin"));
  EXPECT_THAT(read("inside", folder / "a.gltf"), HasSubstr("inside"));
  EXPECT_THROW(readGltf(folder / "none.glb"), InputError);
  EXPECT_THROW(readGltf(folder), InputError);
  std::filesystem::remove_all(folder);
}

TEST(GltfHostile, EveryTruncationOfAGlbIsRefused) {
  const std::vector<std::uint8_t> glb = squareMaker().glb();
  EXPECT_EQ(readGlb(glb, "whole.glb").triangles.size(), 2u);
  for (std::size_t size = 0; size < glb.size(); ++size) {
    const std::vector<std::uint8_t> cut(glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(readGlb(cut, "cut.glb"), InputError) << size;
  }
}

TEST(GltfHostile, EveryTruncationOfAGltfIsRefused) {
  const std::string text = squareMaker().text();
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_NE(complaintAboutText(text.substr(0, size)), "") << size;
}

TEST(GltfHostile, NoSingleByteChangeDoesWorseThanAnInputError) {
  GltfMaker maker = squareMaker();
  const std::uint32_t where = maker.view<std::uint16_t>({1, 2}), values = maker.view<float>({3, 0, 0, 3, 1, 0});
  maker.json["accessors"][0]["sparse"] = {{"count", 2},
                                          {"indices", {{"bufferView", where}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", values}}}};
  squarePrimitive(maker)["attributes"]["NORMAL"] = maker.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  squarePrimitive(maker)["material"] = 0;
  maker.json["materials"] =
      Json::array({{{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}}});
  maker.json["textures"] = Json::array({{{"source", 0}}});
  maker.json["images"] = Json::array({{{"bufferView", 0}, {"mimeType", "image/png"}}});
  maker.json["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
  maker.node({{"camera", 0}, {"rotation", {0, 0, 0, 1}}});
  const std::vector<std::uint8_t> glb = maker.glb();
  std::size_t accepted = 0, refused = 0;
  for (std::size_t i = 0; i < glb.size(); ++i) {
    for (const int value :
         std::initializer_list<int>{0, 0x20, '0', '9', '-', '"', '}', 0x7f, 0x80, 0xff, glb[i] ^ 1, glb[i] ^ 0x80}) {
      std::vector<std::uint8_t> bad = glb;
      bad[i] = static_cast<std::uint8_t>(value);
      try {
        const Scene scene = readGlb(bad, "bad.glb");
        for (const Vec3f& n : scene.normals) ASSERT_NEAR(length(n), 1, 1e-5) << i << " " << value;
        for (const Vec3f& p : scene.positions) ASSERT_TRUE(isFinite(p)) << i << " " << value;
        for (const Triangle& t : scene.triangles) ASSERT_LT(t.material, scene.materials.size());
        ++accepted;
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(accepted, 1000u);
  EXPECT_GT(refused, 1000u);
}

TEST(GltfHostile, ContainersWithMoreThanTheyNeedAreTaken) {
  const GltfMaker maker = squareMaker();
  std::vector<std::uint8_t> trailing = maker.glb();
  trailing.insert(trailing.end(), {1, 2, 3});
  EXPECT_EQ(readGlb(trailing, "trailing.glb").triangles.size(), 2u);
  std::vector<std::uint8_t> chunk = maker.glb();
  chunk.insert(chunk.end(), {4, 0, 0, 0, 'X', 'T', 'R', 'A', 1, 2, 3, 4});
  chunk[8] = static_cast<std::uint8_t>(chunk.size());
  chunk[9] = static_cast<std::uint8_t>(chunk.size() >> 8);
  EXPECT_EQ(readGlb(chunk, "chunk.glb").triangles.size(), 2u);
}

}  // namespace
}  // namespace lucarne::gltf_hostile_test
