// Differences of two scenes in words.
#include "app/scene_difference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/changed_scene.h"
#include "tests/support/scene_builder.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne::scene_difference_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> after(const std::function<void(Json&)>& change) {
  const Scene before = readGlb(test::changedCornellBox([](Json&) {}), "box");
  return sceneDifferences(before, readGlb(test::changedCornellBox(change), "box"));
}

TEST(SceneDifference, OfCamerasAndNamesIsNone) {
  EXPECT_THAT(after([](Json& j) { test::changeWhatLightDoesNotTouch(j); }), IsEmpty());
}

TEST(SceneDifference, NamesWhatChangedFromWhatToWhat) {
  EXPECT_THAT(after([](Json& j) {
                j["nodes"][6]["translation"] = {0.01, 0, 0};
              }),
              ElementsAre("mesh 'block_short': vertices moved"));
  EXPECT_THAT(after([](Json& j) {
                j["materials"][3]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
              }),
              ElementsAre("material 'red': base colour (0.63, 0.065, 0.05) → 0.5"));
  EXPECT_THAT(after([](Json& j) { j["materials"][3]["doubleSided"] = true; }),
              ElementsAre("material 'red': double-sided no → yes"));
  EXPECT_THAT(after([](Json& j) {
                j["materials"][1]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 34000;
              }),
              ElementsAre("material 'light': emissive (1.7e+04, 1.2e+04, 4000) → (3.4e+04, 2.4e+04, 8000) cd/m²"));
  EXPECT_THAT(after([](Json& j) { j["meshes"][4]["primitives"][0]["material"] = 3; }),
              ElementsAre("material 'green' is gone", "mesh 'wall_right_green': material 'green' → 'red'"));
  EXPECT_THAT(after([](Json& j) { j["scenes"][0]["nodes"].erase(7); }), ElementsAre("mesh 'block_tall' is gone"));
  EXPECT_THAT(after([](Json& j) {
                j["nodes"][0]["extras"] = {{"lucarne.texels_per_metre", 64}};
              }),
              ElementsAre("mesh 'floor': texels per metre 0 → 64"));
}

/// A floor under two lights.
Scene lit(const std::function<void(Light&, Light&)>& change) {
  test::SceneBuilder s;
  s.addDiffuse(Rgb{0.5f});
  s.addBox({0, 0, 0}, {2, 2, 2}, 0, true);
  Light sun, bulb;
  sun.name = "sun";
  sun.kind = LightKind::directional;
  sun.intensity = Rgb{3.f};
  bulb.name = "bulb";
  bulb.position = {1, 1, 1};
  change(sun, bulb);
  s.addLight(sun);
  s.addLight(bulb);
  return s.build();
}

TEST(SceneDifference, OfLightsHasTheirUnits) {
  const Scene before = lit([](Light&, Light&) {});
  EXPECT_THAT(sceneDifferences(before, lit([](Light& sun, Light&) { sun.intensity = Rgb{4.f}; })),
              ElementsAre("light 'sun': intensity 3 → 4 lx"));
  EXPECT_THAT(sceneDifferences(before, lit([](Light&, Light& bulb) { bulb.position.y = 1.5; })),
              ElementsAre("light 'bulb': moved"));
  EXPECT_THAT(sceneDifferences(before, lit([](Light&, Light& bulb) {
                                 bulb.intensity = {1, 2, 3};
                               })),
              ElementsAre("light 'bulb': intensity 1 → (1, 2, 3) cd"));
  EXPECT_THAT(sceneDifferences(before, lit([](Light& sun, Light&) { sun.name = "moon"; })), IsEmpty());
  EXPECT_THAT(sceneDifferences(before, lit([](Light& sun, Light&) {
                                 sun.name = "moon";
                                 sun.intensity = Rgb{0.25f};
                               })),
              ElementsAre("light 'sun' is gone", "light 'moon' is new"));
}

TEST(SceneDifference, OfNamesBesideAnotherOneIsNotNamed) {
  EXPECT_THAT(after([](Json& j) {
                test::changeWhatLightDoesNotTouch(j);
                j["materials"][3]["doubleSided"] = true;
              }),
              ElementsAre("material 'red': double-sided no → yes"));
}

TEST(SceneDifference, ThatIsTooSmallToShowIsNamedAllTheSame) {
  const auto differences =
      after([](Json& j) { j["materials"][3]["pbrMetallicRoughness"]["baseColorFactor"][0] = 0.6300001; });
  EXPECT_THAT(differences, ElementsAre("material 'red': base colour differs slightly"));
}

TEST(SceneDifference, InOneLineShowsAFewAndCountsTheRest) {
  EXPECT_EQ(someOf({"a", "b", "c", "d", "e"}), "a; b; c; and 2 more");
  EXPECT_EQ(someOf({"a"}), "a");
}

}  // namespace
}  // namespace lucarne::scene_difference_test
