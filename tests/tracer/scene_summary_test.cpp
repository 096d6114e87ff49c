#include "tracer/scene/scene_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/scene_builder.h"

namespace lucarne::scene_summary_test {
namespace {

TEST(SceneSummary, CountsTrianglesLightsAndBoundsInMetres) {
  test::SceneBuilder builder;
  builder.addDiffuse({0.5f, 0.5f, 0.5f});
  Material lamp = test::diffuseMaterial(Rgb{0.f}, {10, 20, 30});
  lamp.name = "lamp";
  lamp.doubleSided = true;
  builder.addMaterial(lamp);
  builder.addBox({1000, 0, 0}, {1004, 2, 1}, 0);
  builder.addQuad({1001, 1, 0.5}, {1002, 1, 0.5}, {1002, 1, 1}, {1001, 1, 1}, 1);
  builder.addTriangle({1001, 1, 1}, {1001, 1, 1}, {1002, 1, 1}, 0);
  builder.addLight({.name = "sun", .kind = LightKind::directional, .intensity = Rgb{5.f}});
  builder.addLight({.name = "bulb"});
  builder.addCamera({1001, 1, 1}, {1003, 1, 0.5});
  Scene scene = builder.build();
  scene.leftOut = {"fog: ignored"};
  const nlohmann::json s = summarize(scene);
  EXPECT_EQ(s["triangles"], 15);
  EXPECT_EQ(s["degenerate_triangles"], 1);
  EXPECT_EQ(s["smooth_triangles"], 0);
  EXPECT_EQ(s["double_sided_triangles"], 2);
  EXPECT_EQ(s["double_sided_materials"], 1);
  EXPECT_EQ(s["emissive_triangles"], 2);
  EXPECT_EQ(s["emissive_materials"][0]["name"], "lamp");
  EXPECT_EQ(s["lights"][0]["unit"], "lx");
  EXPECT_EQ(s["lights"][1]["unit"], "cd");
  EXPECT_EQ(s["cameras"].size(), 1u);
  EXPECT_EQ(s["bounds_m"]["min"][0], 1000.0);
  EXPECT_EQ(s["bounds_m"]["size"], nlohmann::json::array({4.0, 2.0, 1.0}));
  EXPECT_EQ(s["charts"], 0);
  EXPECT_EQ(s["left_out"][0], "fog: ignored");
}

TEST(SceneSummary, SceneWithoutTrianglesHasNoBounds) {
  const nlohmann::json s = summarize(test::SceneBuilder().build());
  EXPECT_TRUE(s["bounds_m"].is_null());
  EXPECT_EQ(s["triangles"], 0);
}

}  // namespace
}  // namespace lucarne::scene_summary_test
