// Sections of a check against closed forms and against what a bake then does.
#include "app/check.h"

#include <gtest/gtest.h>

#include "app/bake_scene.h"
#include "app/check_features.h"
#include "app/check_layout.h"
#include "app/check_lights.h"
#include "app/check_time.h"
#include "tests/support/scene_builder.h"

namespace lucarne::check_test {
namespace {

using nlohmann::json;

constexpr double kPi = 3.14159265358979323846;

/// A scene with all that a check asks of it.
struct Checked {
  explicit Checked(const Scene& scene_, BakeOptions options_ = {})
      : scene(scene_),
        options(std::move(options_)),
        photonScene(scene),
        plan(makePlan(scene, options)),
        input{options, photonScene, plan, 1000, 0.5, {1'000'000, 2'000'000}} {}

  bool warned(const std::string& id) const {
    for (const json& w : warnings.list())
      if (w["id"] == id) return true;
    return false;
  }

  Scene scene;
  BakeOptions options;
  PhotonScene photonScene;
  BakePlan plan;
  CheckInput input;
  CheckWarnings warnings, failures;
};

/// A closed room of two metres, grey, its fronts inside.
test::SceneBuilder room(double size = 2) {
  test::SceneBuilder builder;
  builder.addDiffuse(Rgb{0.5f});
  builder.addBox({0, 0, 0}, {size, size, size}, 0, true);
  return builder;
}

Light light(LightKind kind, Rgb intensity, const std::string& name = "l") {
  Light l;
  l.name = name;
  l.kind = kind;
  l.intensity = intensity;
  l.position = {1, 1, 1};
  l.direction = {0, -1, 0};
  return l;
}

TEST(CheckLights, FluxOfEachKindIsItsClosedForm) {
  test::SceneBuilder builder = room();
  builder.addLight(light(LightKind::point, {30, 20, 10}, "bulb"));
  Light spot = light(LightKind::spot, Rgb{5.f}, "spot");
  spot.cosInner = 0.9;
  spot.cosOuter = 0.6;
  builder.addLight(spot);
  builder.addLight(light(LightKind::directional, Rgb{7.f}, "sun"));
  Checked c(builder.build());
  const json lights = checkLights(c.input, c.warnings);
  double sum = 0, shares = 0;
  for (const json& s : lights["sources"]) {
    sum += s["luminous_flux_lm"].get<double>();
    shares += s["share"].get<double>();
    if (s["name"] == "bulb") {
      EXPECT_NEAR(s["flux_lm"][0].get<double>(), 4 * kPi * 30, 1e-3);
      EXPECT_NEAR(s["luminous_flux_lm"].get<double>(), 4 * kPi * luminance(Rgbd{30, 20, 10}), 1e-3);
      EXPECT_EQ(s["unit"], "cd");
    } else if (s["name"] == "spot") {
      EXPECT_NEAR(s["luminous_flux_lm"].get<double>(), 5 * 2 * kPi * (0.1 + 0.3 / 3), 1e-3);
    } else {
      // A disc as large as the sphere around a cube of two metres, and a ten-thousandth wider against rounding.
      EXPECT_NEAR(s["luminous_flux_lm"].get<double>(), 7 * kPi * 3 * 1.0001 * 1.0001, 1e-3);
      EXPECT_EQ(s["unit"], "lx");
    }
  }
  EXPECT_NEAR(lights["luminous_flux_lm"].get<double>(), sum, 1e-9 * sum);
  EXPECT_NEAR(shares, 1, 1e-9);
  EXPECT_TRUE(c.warnings.list().empty()) << c.warnings.list();
}

TEST(CheckLights, AnEmissiveMaterialIsOneSourceWithBothItsSides) {
  test::SceneBuilder builder = room();
  Material lamp = test::diffuseMaterial(Rgb{0.f}, {100, 200, 300});
  lamp.name = "lamp";
  lamp.doubleSided = true;
  const std::uint32_t m = builder.addMaterial(lamp);
  builder.addQuad({0.5, 1, 0.5}, {1, 1, 0.5}, {1, 1, 1.5}, {0.5, 1, 1.5}, m);
  Checked c(builder.build());
  const json lights = checkLights(c.input, c.warnings);
  ASSERT_EQ(lights["sources"].size(), 1u);
  const json& s = lights["sources"][0];
  EXPECT_EQ(s["kind"], "emissive");
  EXPECT_EQ(s["triangles"], 2);
  EXPECT_NEAR(s["area_m2"].get<double>(), 0.5, 1e-6);
  EXPECT_NEAR(s["flux_lm"][2].get<double>(), 2 * kPi * 0.5 * 300, 1e-2);
  EXPECT_EQ(lights["punctual_luminous_flux_lm"], 0.0);
}

TEST(CheckLights, ATexturedEmitterHasTheMeanOfItsTexture) {
  test::SceneBuilder builder = room();
  Material lamp = test::diffuseMaterial(Rgb{0.f}, {100, 100, 100});
  lamp.emissiveTexture.texture = 0;
  const std::uint32_t m = builder.addMaterial(lamp);
  builder.addQuad({0.5, 1, 0.5}, {1, 1, 0.5}, {1, 1, 1.5}, {0.5, 1, 1.5}, m);
  Scene scene = builder.build();
  scene.images.push_back({2, 1, {255, 0, 0, 255, 255, 0, 0, 255}});
  scene.textures.push_back({0, Wrap::repeat, Wrap::repeat, true});
  Checked c(scene);
  const json s = checkLights(c.input, c.warnings)["sources"][0];
  EXPECT_NEAR(s["flux_lm"][0].get<double>(), kPi * 0.5 * 100, 1e-2);
  EXPECT_NEAR(s["flux_lm"][1].get<double>(), 0, 1e-6);
  EXPECT_EQ(s["textured"], true);
}

TEST(CheckLights, DarkLightsAndOddUnitsAreWarnedOf) {
  Checked black(room().build());
  EXPECT_EQ(checkLights(black.input, black.warnings)["luminous_flux_lm"], 0.0);
  EXPECT_TRUE(black.warned("no_light"));

  test::SceneBuilder builder = room();
  builder.addLight(light(LightKind::point, Rgb{0.f}, "broken"));
  builder.addLight(light(LightKind::point, Rgb{2e5f}, "watts"));
  builder.addMaterial(test::diffuseMaterial(Rgb{0.f}, Rgb{1.f}));
  builder.addQuad({0.5, 1, 0.5}, {1, 1, 0.5}, {1, 1, 1.5}, {0.5, 1, 1.5}, 1);
  Checked odd(builder.build());
  checkLights(odd.input, odd.warnings);
  EXPECT_FALSE(odd.warned("no_light"));
  EXPECT_TRUE(odd.warned("dark_light"));
  EXPECT_TRUE(odd.warned("bright_light"));
  EXPECT_TRUE(odd.warned("mixed_units"));
}

TEST(CheckSize, ScenesInOtherUnitsThanMetresAreWarnedOf) {
  for (const auto& [size, odd] : {std::pair(0.009, true), {0.011, false}, {999.0, false}, {1001.0, true}}) {
    Checked c(room(size).build());
    EXPECT_NEAR(checkSize(c.input, c.warnings)["extent_m"][0].get<double>(), size, 1e-6 * size);
    EXPECT_EQ(c.warned("units"), odd) << size;
  }
}

TEST(CheckFeatures, OnlyMaterialsOfTrianglesCount) {
  test::SceneBuilder builder = room();
  Material glass = test::diffuseMaterial(Rgb{1.f});
  glass.transmission = 1;
  glass.ior = 1.33f;
  glass.doubleSided = true;
  builder.addMaterial(glass);
  const auto count = [](const json& list, const std::string& feature, const std::string& of) {
    for (const json& f : list)
      if (f["feature"] == feature && f["of"] == of) return f["count"].get<int>();
    return 0;
  };
  const json unused = listModelled(builder.build());
  EXPECT_EQ(count(unused, "transmission", "materials"), 0);
  EXPECT_EQ(count(unused, "specular", "materials"), 1) << "the room's own";
  builder.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  const json used = listModelled(builder.build());
  EXPECT_EQ(count(used, "transmission", "materials"), 1);
  EXPECT_EQ(count(used, "ior", "materials"), 1);
  EXPECT_EQ(count(used, "double-sided", "triangles"), 1);
  EXPECT_EQ(count(used, "alpha mask", "materials"), 0);
}

TEST(CheckUv, AreaAndBoundsOfTheSecondSet) {
  test::SceneBuilder builder;
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  builder.addTriangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});  // uv all zero
  Scene scene = builder.build();
  EXPECT_EQ(checkUv(scene)["present"], false);
  scene.atlasUv = scene.uv0;
  const json whole = checkUv(scene);
  EXPECT_EQ(whole["inside_unit_square"], true);
  EXPECT_NEAR(whole["area"].get<double>(), 1, 1e-12);
  EXPECT_EQ(whole["triangles_without_area"], 1);
  scene.atlasUv[1].x = 1.5f;
  EXPECT_EQ(checkUv(scene)["inside_unit_square"], false);
}

TEST(CheckLayout, CountsTheTexelsOfTheBake) {
  BakeOptions options;
  options.texelsPerMetre = 8;
  options.keepAllDirections = true;
  Checked c(room().build(), options);
  const json layout = checkLayout(c.input, c.warnings);
  EXPECT_EQ(layout["charts"], 6);
  EXPECT_EQ(layout["texels"], 6 * 16 * 16);
  EXPECT_EQ(layout["covered_texels"], 6 * 16 * 16);
  EXPECT_EQ(layout["sides_with_directions"], 6);
  EXPECT_NEAR(layout["mean_texel_mm"].get<double>(), 125, 1e-6);
  EXPECT_EQ(layout["largest_chart"]["width"], 16);
  EXPECT_TRUE(c.warnings.list().empty()) << c.warnings.list();

  options.texelBudget = 600;
  Checked thin(room().build(), options);
  EXPECT_EQ(checkLayout(thin.input, thin.warnings)["thinned"], true);
  EXPECT_TRUE(thin.warned("thinned"));
}

TEST(CheckResources, MapsOfABakeAreNoLargerThanSaid) {
  test::SceneBuilder builder = room();
  builder.addLight(light(LightKind::point, Rgb{10.f}));
  BakeOptions options;
  options.photons = 20'000;
  options.keepAllDirections = true;
  options.threads = 2;
  Checked c(builder.build(), options);
  const json r = checkResources(c.input, c.warnings, c.failures);
  EXPECT_EQ(r["tally_bytes"], c.plan.tallies.bytes());
  EXPECT_EQ(r["expected_peak_memory_bytes"], predictMemory(options, c.photonScene.scene(), c.plan, c.input.memory).peak());
  EXPECT_GE(r["expected_peak_memory_bytes"], 1'000'000 + 2 * c.plan.tallies.bytes());
  const Baked baked = bakeScene(c.photonScene, c.plan, c.options, [](const RunProgress&) { return true; });
  EXPECT_LE(baked.maps.directional.size() * sizeof(Rgb) + baked.maps.irradiance.size() * 20, r["map_bytes"]);
}

TEST(CheckTime, AClosedRoomWastesNothingAndAnOpenOneHalf) {
  test::SceneBuilder closed = room();
  closed.addLight(light(LightKind::point, Rgb{10.f}));
  Checked c(closed.build());
  const json layout = checkLayout(c.input, c.warnings);
  const json time = checkTime(c.input, layout, c.warnings, c.failures);
  EXPECT_GT(time["photons_per_second"].get<double>(), 0);
  EXPECT_TRUE(std::isfinite(time["seconds"].get<double>()));
  EXPECT_EQ(time["missed"], 0.0);
  EXPECT_EQ(time["lost"], 0.0);
  EXPECT_EQ(time["escaped"], 0.0);
  // Roulette keeps half of the photons at each bounce of albedo ½: two rays on average; five standard errors (√2/√n) of
  // the smallest sample.
  EXPECT_NEAR(time["rays_per_photon"].get<double>(), 2, 5 * std::sqrt(2.0 / 512));

  // One floor of infinite looks, and a lamp above it: half of the light goes up.
  test::SceneBuilder open;
  open.addDiffuse(Rgb{0.f});
  open.addQuad({-1000, 0, 1000}, {1000, 0, 1000}, {1000, 0, -1000}, {-1000, 0, -1000});
  open.addLight(light(LightKind::point, Rgb{10.f}));
  Checked o(open.build());
  const json openTime = checkTime(o.input, checkLayout(o.input, o.warnings), o.warnings, o.failures);
  EXPECT_NEAR(openTime["missed"].get<double>(), 0.5, 5 * 0.5 / std::sqrt(512.0));
  EXPECT_EQ(openTime["lost"], 0.0);
}

TEST(CheckTime, LightOnBlackBacksIsLostAndWarnedOf) {
  test::SceneBuilder builder;
  builder.addDiffuse(Rgb{0.5f});
  builder.addBox({0, 0, 0}, {2, 2, 2});  // the lamp is inside, the fronts outside
  builder.addLight(light(LightKind::point, Rgb{10.f}));
  Checked c(builder.build());
  const json time = checkTime(c.input, checkLayout(c.input, c.warnings), c.warnings, c.failures);
  EXPECT_EQ(time["lost"], 1.0);
  EXPECT_EQ(time["missed"], 0.0);
  EXPECT_TRUE(c.warned("lost"));
}

TEST(CheckText, EverySectionIsThereAndNamesCannotCommandATerminal) {
  BakeOptions options;
  json checked = checkScene(options);
  checked["lights"]["sources"][0]["name"] = "bad\x1b[2J\nname" + std::string(500, 'x');
  const std::string text = checkText(checked);
  for (const char* title :
       {"scene ", "modelled ", "left out ", "lights ", "uv ", "layout ", "memory ", "disk ", "time ", "warnings "})
    EXPECT_NE(("\n" + text).find(std::string("\n") + title), std::string::npos) << title << "\n" << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find(std::string(100, 'x')), std::string::npos);
}

}  // namespace
}  // namespace lucarne::check_test
