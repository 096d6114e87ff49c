// Open and closed meshes, and what follows for the density of texels.
#include "app/check_surfaces.h"

#include <gtest/gtest.h>

#include "app/bake_scene.h"
#include "app/check_layout.h"
#include "app/check_lights.h"
#include "tests/support/changed_scene.h"
#include "tests/support/scene_builder.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne::check_surfaces_test {
namespace {

using nlohmann::json;

json surfacesOf(const std::function<void(Json&)>& change) {
  return checkSurfaces(readGlb(test::changedCornellBox(change), "box"));
}

TEST(CheckSurfaces, BlocksWithoutABottomAndWallsAreOpen) {
  const json s = surfacesOf([](Json&) {});
  EXPECT_EQ(s["meshes"], 8);
  EXPECT_EQ(s["open"].get<int>() + s["closed"].get<int>(), 8);
  EXPECT_EQ(s["list"].size(), s["open"].get<std::size_t>());
  EXPECT_EQ(s["crowded_edges"], 0);
  for (const json& mesh : s["list"]) {
    if (mesh["name"] == "wall_back") {
      EXPECT_EQ(mesh["open_edges"], 4) << "a rectangle has four edges, its diagonal is none of them";
    }
  }
}

TEST(CheckSurfaces, DoubleSidedAndTransparentMeshesAreNotBlackFromBehind) {
  const int before = surfacesOf([](Json&) {})["one_sided_open"];
  EXPECT_EQ(surfacesOf([](Json& j) { j["materials"][3]["doubleSided"] = true; })["one_sided_open"], before - 1);
  EXPECT_EQ(surfacesOf([](Json& j) {
              j["materials"][3]["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
            })["one_sided_open"],
            before - 1);
}

/// One mesh of the triangles in `builder`.
Scene asOneMesh(const test::SceneBuilder& builder) {
  Scene scene = builder.build();
  scene.instances = {{0, 0, 0, 0, static_cast<std::uint32_t>(scene.triangles.size()), 0,
                      static_cast<std::uint32_t>(scene.positions.size()), 0}};
  return scene;
}

TEST(CheckSurfaces, AClosedBoxIsClosedThoughItsFacesShareNoVertex) {
  test::SceneBuilder box;
  box.addDiffuse(Rgb{0.5f});
  box.addBox({0, 0, 0}, {1, 2, 3});
  const json s = checkSurfaces(asOneMesh(box));
  EXPECT_EQ(s["closed"], 1);
  EXPECT_EQ(s["list"], json::array());
}

TEST(CheckSurfaces, AWallInsideABoxCrowdsItsEdges) {
  test::SceneBuilder box;
  box.addDiffuse(Rgb{0.5f});
  box.addBox({0, 0, 0}, {1, 1, 1});
  box.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1});
  const json s = checkSurfaces(asOneMesh(box));
  EXPECT_EQ(s["crowded_edges"], 4) << "along two edges of the box and two diagonals of its sides";
}

TEST(CheckDensity, IsThatOfEveryChart) {
  const Scene scene = readGlb(test::changedCornellBox([](Json& j) {
                                j["nodes"][0]["extras"] = {{"lucarne.texels_per_metre", 100}};
                              }),
                              "box");
  BakeOptions options;
  options.texelsPerMetre = 40;
  const PhotonScene photonScene(scene);
  const BakePlan plan = makePlan(scene, options);
  CheckWarnings warnings;
  const json layout = checkLayout({options, photonScene, plan}, warnings);
  // Charts get whole texels: a little more than asked for.
  EXPECT_GE(layout["texels_per_metre_min"].get<double>(), 40);
  EXPECT_GE(layout["texels_per_metre_median"].get<double>(), 40);
  EXPECT_LE(layout["texels_per_metre_median"].get<double>(), 44);
  EXPECT_GE(layout["texels_per_metre_max"].get<double>(), 100);
  EXPECT_LE(layout["texels_per_metre_max"].get<double>(), 110);
}

TEST(CheckLights, OfAMillionthOfTheStrongestAreNamed) {
  test::SceneBuilder room;
  room.addDiffuse(Rgb{0.5f});
  room.addBox({0, 0, 0}, {2, 2, 2}, 0, true);
  Light lamp, led;
  lamp.name = "lamp";
  lamp.intensity = Rgb{90'000.f};
  led.name = "led";
  led.intensity = Rgb{0.05f};
  room.addLight(lamp);
  room.addLight(led);
  const Scene scene = room.build();
  const PhotonScene photonScene(scene);
  const BakeOptions options;
  const BakePlan plan = makePlan(scene, options);
  CheckWarnings warnings;
  checkLights({options, photonScene, plan}, warnings);
  ASSERT_EQ(warnings.list().size(), 1u) << warnings.list();
  EXPECT_EQ(warnings.list()[0]["id"], "faint_light");
  EXPECT_NE(warnings.list()[0]["text"].get<std::string>().find("'led'"), std::string::npos);
}

}  // namespace
}  // namespace lucarne::check_surfaces_test
