// Real scenes, and files that others found to break readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "tests/tracer/gltf_files.h"
#include "tracer/scene/gltf_packer.h"
#include "tracer/scene/gltf_reader.h"
#include "tracer/scene/gltf_writer.h"
#include "tracer/scene/scene_summary.h"

namespace lucarne::gltf_assets_test {
namespace {

namespace fs = std::filesystem;

using test::gltfFilesBelow;
using test::kAssets;

bool hasNormalMap(const Scene& scene) {
  return std::any_of(scene.triangles.begin(), scene.triangles.end(),
                     [&](const Triangle& t) { return bool(scene.materials[t.material].normalTexture); });
}

/// Unit, in the plane of the normal, ±1, and there where a normal map is.
void expectTangentFrames(const Scene& scene, const fs::path& file) {
  ASSERT_EQ(scene.tangents.size(), hasNormalMap(scene) ? scene.positions.size() : 0) << file;
  std::size_t bad = 0;
  for (std::size_t v = 0; v < scene.tangents.size(); ++v) {
    const Vec3f t{scene.tangents[v].x, scene.tangents[v].y, scene.tangents[v].z};
    bad += !(std::fabs(length(t) - 1) < 1e-5f && std::fabs(dot(t, scene.normals[v])) < 1e-5f &&
             std::fabs(scene.tangents[v].w) == 1);
  }
  EXPECT_EQ(bad, 0u) << file;
}

TEST(GltfAssets, MalformedFilesAreRefusedOrRead) {
  if (!fs::exists(kAssets / "malformed")) GTEST_SKIP() << "no folder " << kAssets / "malformed";
  std::set<std::string> accepted;
  for (const fs::path& file : gltfFilesBelow(kAssets / "malformed")) {
    try {
      readGltf(file);
      accepted.insert(file.filename().string());
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr("malformed")) << file;
    }
  }
  // Its normals are zero: the geometric ones stand in. All others break a rule or have no triangles.
  EXPECT_EQ(accepted, std::set<std::string>{"box_bad_normals.glb"});
}

TEST(GltfAssets, ScenesAndModelsLoadWithUnitNormalsAndWithinTheLocalFrame) {
  if (!fs::exists(kAssets / "scenes")) GTEST_SKIP() << "no folder " << kAssets / "scenes";
  const std::map<std::string, std::size_t> triangles = {{"country_kitchen.glb", 433741}, {"lux_kitchen.glb", 82742},
                                                        {"living_room.glb", 5088},       {"hotel_room.glb", 99029},
                                                        {"cornellBox.gltf", 16732},      {"lights_minimal.glb", 12},
                                                        {"dream_apartment.glb", 177934}, {"avocado.glb", 682}};
  for (const char* folder : {"scenes", "models"}) {
    for (const fs::path& file : gltfFilesBelow(kAssets / folder)) {
      const Scene scene = readGltf(file);
      const auto known = triangles.find(file.filename().string());
      if (known != triangles.end()) {
        EXPECT_EQ(scene.triangles.size(), known->second) << file;
      }
      Box box;
      for (const Vec3f& p : scene.positions) box.add(Vec3d(p));
      EXPECT_GE(maxComponent(box.extent()), 1 - 1e-6) << file;
      EXPECT_LT(maxComponent(box.extent()), 2 + 1e-6) << file;
      std::size_t notUnit = 0;
      for (const Vec3f& n : scene.normals) notUnit += std::fabs(length(n) - 1) > 1e-5f;
      EXPECT_EQ(notUnit, 0u) << file;
      expectTangentFrames(scene, file);
    }
  }
}

TEST(GltfAssets, WrittenScenesComeBackBitForBit) {
  if (!fs::exists(kAssets / "scenes")) GTEST_SKIP() << "no folder " << kAssets / "scenes";
  for (const char* name :
       {"scenes/cornell_nv/cornellBox.gltf", "scenes/living_room.glb", "scenes/hotel_room.glb",
        "models/sheen_chair.glb", "models/velvet_sofa.glb", "models/avocado.glb", "scenes/lights_minimal.glb"}) {
    const Scene scene = readGltf(kAssets / name);
    AtlasUv uv;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const float x = static_cast<float>(t % 256) / 256;
      uv.corner.push_back({Vec2f{x, 0}, Vec2f{x, 0.5f}, Vec2f{x + 0.1f, 1}});
      uv.chartOfTriangle.push_back(t % 3 == 0 ? kNone : t);
    }
    const Scene again = readGlb(writeSceneGlb(scene, uv), name);
    ASSERT_EQ(again.triangles.size(), scene.triangles.size()) << name;
    ASSERT_EQ(again.tangents.size(), scene.tangents.empty() ? 0 : again.positions.size()) << name;
    std::size_t different = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = scene.triangles[t].v[k], w = again.triangles[t].v[k];
        const bool same = scene.positions[v] == again.positions[w] && scene.normals[v] == again.normals[w] &&
                          again.atlasUv[w] == uv.corner[t][k] &&
                          (scene.tangents.empty() || scene.tangents[v] == again.tangents[w]);
        different += !same;
      }
    }
    EXPECT_EQ(different, 0u) << name;
    EXPECT_EQ(again.chartOfTriangle, uv.chartOfTriangle) << name;
    EXPECT_EQ(again.leftOut, scene.leftOut) << name;
    EXPECT_EQ(again.tangents.empty(), scene.tangents.empty()) << name;
    EXPECT_EQ(again.skipped, scene.skipped) << name;
  }
}

/// The file's own tangents, made by other programs, against those that the reader computes without them.
TEST(GltfAssets, ComputedTangentsAgreeWithThoseOfTheFile) {
  if (!fs::exists(kAssets / "models")) GTEST_SKIP() << "no folder " << kAssets / "models";
  for (const char* name : {"models/avocado.glb", "models/water_bottle.glb", "scenes/lights_punctual_lamp.glb"}) {
    const Scene given = readGltf(kAssets / name);
    GltfSource bare = *given.source;
    for (Json& mesh : bare.json["meshes"]) {
      for (Json& primitive : mesh["primitives"]) primitive["attributes"].erase("TANGENT");
    }
    const Scene computed = readGlb(packGltf(bare), name);
    ASSERT_EQ(computed.triangles.size(), given.triangles.size()) << name;
    std::size_t corners = 0, along = 0, sameSide = 0;
    for (std::uint32_t t = 0; t < given.triangles.size(); ++t) {
      if (!given.materials[given.triangles[t].material].normalTexture || given.skipped[t] != 0) continue;
      for (const int k : {0, 1, 2}) {
        const Vec4f a = given.tangents[given.triangles[t].v[k]], b = computed.tangents[computed.triangles[t].v[k]];
        ++corners;
        along += a.x * b.x + a.y * b.y + a.z * b.z > 0.95f;
        sameSide += a.w == b.w;
      }
    }
    EXPECT_GT(along, corners * 0.98) << name;
    EXPECT_GT(sameSide, corners * 0.99) << name;
  }
}

TEST(GltfAssets, SummaryCountsWhatTheFilesHold) {
  if (!fs::exists(kAssets / "scenes")) GTEST_SKIP() << "no folder " << kAssets / "scenes";
  const nlohmann::json lights = summarize(readGltf(kAssets / "scenes/lights_minimal.glb"));
  EXPECT_EQ(lights["lights"].size(), 4u);
  EXPECT_EQ(lights["cameras"].size(), 1u);
  const nlohmann::json cornell = summarize(readGltf(kAssets / "scenes/cornell_nv/cornellBox.gltf"));
  EXPECT_EQ(cornell["emissive_materials"].size(), 1u);
  EXPECT_EQ(cornell["emissive_materials"][0]["emissive_cd_per_m2"], nlohmann::json::array({10, 10, 10}));
}

}  // namespace
}  // namespace lucarne::gltf_assets_test
