#include <gtest/gtest.h>

#include "app/compare.h"
#include "tests/app/bake_fixture.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::compare_maps_test {
namespace {

/// `action` must fail with `code` and say `words`.
template <class Action>
void expectError(Action action, ExitCode code, const std::string& words) {
  const std::string text = errorOf(code, action);
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

using test::BakedScene;
using test::SceneBuilder;

/// A closed room with a glossy floor, lit by a lamp below its ceiling. `height` moves the ceiling.
Scene room(double height = 2) {
  SceneBuilder s;
  s.addBox({0, 0, 0}, {3, height, 2.5}, s.addDiffuse(Rgb(0.5f)), true);
  Material glossy = test::diffuseMaterial(Rgb(0.3f));
  glossy.specular = 1;
  glossy.roughness = 0.4f;
  const auto floor = s.addMaterial(glossy);
  s.addQuad({0.5, 0.01, 0.5}, {0.5, 0.01, 2}, {2.5, 0.01, 2}, {2.5, 0.01, 0.5}, floor);
  const auto lamp = s.addDiffuse(Rgb(0.5f), Rgb(100.f, 80.f, 60.f));
  s.addQuad({1, height - 0.1, 1}, {2, height - 0.1, 1}, {2, height - 0.1, 1.5}, {1, height - 0.1, 1.5}, lamp);
  return s.build();
}

class CompareMaps : public testing::Test {
 protected:
  static BakedScene bake(std::uint64_t seed = 0, double density = 6, const Scene& scene = room()) {
    BakeOptions o = test::quickOptions(100'000, density);
    o.seed = seed;
    return {scene, o};
  }
  void write(const std::string& name, const BakedScene& b, const LightMaps& maps) {
    DlmFormat format;
    format.directional = MapFormat::float32;
    writeDlm(folder_ / name, b.scene, b.baked.uv, maps, nlohmann::json::object(), format);
  }
  void write(const std::string& name, const BakedScene& b) { write(name, b, b.baked.maps); }
  nlohmann::json compared(std::uint64_t points = 20'000) {
    return compare({folder_ / "a.dlm", folder_ / "b.dlm", {}, points, {}, {}, {}});
  }
  TempFolder folder_;
};

TEST_F(CompareMaps, EqualOnesDifferByNothingAndOnesScaledByTheirFactor) {
  const BakedScene b = bake();
  write("a.dlm", b);
  write("b.dlm", b);
  auto d = compared();
  EXPECT_EQ(d["compared"], "texel by texel");
  EXPECT_EQ(d["irradiance"]["rmse_lx"], 0.0);
  EXPECT_EQ(d["irradiance"]["mean_ratio"], 1.0);
  EXPECT_EQ(d["directional"]["relative_error"], 0.0);
  // 2·(3·2.5 + 3·2 + 2.5·2) + 2·1.5 + 1·0.5
  EXPECT_NEAR(d["surface_m2"].get<double>(), 40.5, 1e-3);

  LightMaps maps = b.baked.maps;
  for (Rgb& v : maps.irradiance) v = v * 1.25f;
  for (Rgb& v : maps.directional) v = v * 0.5f;
  write("b.dlm", b, maps);
  d = compared();
  EXPECT_NEAR(d["irradiance"]["mean_ratio"].get<double>(), 1.25, 1e-6);
  EXPECT_NEAR(d["irradiance"]["relative_error"].get<double>(), 0.25, 1e-6);
  EXPECT_NEAR(d["directional"]["mean_ratio"].get<double>(), 0.5, 1e-6);
  EXPECT_GE(d["directional"]["by_direction"].size(), 7u);
  for (const auto& one : d["directional"]["by_direction"]) EXPECT_NEAR(one["relative_error"].get<double>(), 0.5, 1e-6);
}

TEST_F(CompareMaps, TheLargestDifferenceIsFoundWhereItIs) {
  const BakedScene b = bake();
  write("a.dlm", b);
  LightMaps maps = b.baked.maps;
  // A texel in the middle of some wall.
  const SideMaps* side = nullptr;
  for (const SideMaps& s : maps.sides) {
    if (s.lit && s.width > 8 && s.height > 8) side = &s;
  }
  ASSERT_NE(side, nullptr);
  const int x = 5, y = 3;
  maps.irradiance[side->firstTexel + static_cast<std::uint64_t>(y * side->width + x)].y += 1e5f;
  write("b.dlm", b, maps);
  const auto d = compared();
  const auto& at = d["irradiance"]["largest"];
  EXPECT_NEAR(at["difference_lx"].get<double>(), 1e5, 1);
  EXPECT_EQ(at["chart"], side->chart);
  // Asking b there gives the same texel.
  const Dlm read = readDlm(folder_ / "b.dlm");
  const MapChart& chart = read.maps.charts[side->chart];
  const Vec3d position{at["position"][0], at["position"][1], at["position"][2]};
  const ProbeAnswer answer = Prober(read).probe(position, Vec3d(chart.normal));
  EXPECT_EQ(answer.chart, side->chart);
  EXPECT_GT(answer.irradiance.y, 9e4);
}

// The estimate is that of independent photons; theirs are spread more evenly.
TEST_F(CompareMaps, BakesOfTwoSeedsDifferByNoMoreThanTheNoiseThatTheyTell) {
  write("a.dlm", bake(1));
  const BakedScene b = bake(2);
  write("b.dlm", b);
  auto d = compared();
  EXPECT_GT(d["irradiance"]["relative_error"].get<double>(), 1e-3);
  EXPECT_GT(d["irradiance"]["times_expected_noise"].get<double>(), 0.4);
  EXPECT_LT(d["irradiance"]["times_expected_noise"].get<double>(), 1.1);
  EXPECT_NEAR(d["irradiance"]["mean_ratio"].get<double>(), 1, 0.02);
  LightMaps brighter = b.baked.maps;
  for (Rgb& v : brighter.irradiance) v = v * 1.4f;
  write("b.dlm", b, brighter);
  d = compared();
  EXPECT_GT(d["irradiance"]["times_expected_noise"].get<double>(), 1.5);
}

TEST_F(CompareMaps, OtherLayoutsAreComparedInTheWorld) {
  const BakedScene a = bake(1, 6);
  write("a.dlm", a);
  write("b.dlm", bake(1, 8));
  const auto d = compared();
  EXPECT_EQ(d["compared"], "at points");
  EXPECT_EQ(d["samples"], 20'000);
  EXPECT_NEAR(d["surface_m2"].get<double>(), 40.5, 1e-3);
  EXPECT_NEAR(d["irradiance"]["mean_ratio"].get<double>(), 1, 0.02);
  EXPECT_LT(d["irradiance"]["relative_error"].get<double>(), 0.1);
  EXPECT_LT(d["directional"]["relative_error"].get<double>(), 0.3);

  LightMaps brighter = a.baked.maps;
  for (Rgb& v : brighter.irradiance) v = v * 1.5f;
  write("a.dlm", bake(1, 8));
  write("b.dlm", a, brighter);
  EXPECT_NEAR(compared()["irradiance"]["mean_ratio"].get<double>(), 1.5, 0.02);
}

TEST_F(CompareMaps, OtherScenesAndOptionsOfPicturesAreRefused) {
  write("a.dlm", bake());
  SceneBuilder s;
  s.addBox({10, 0, 0}, {12, 2, 2}, s.addDiffuse(Rgb(0.5f), Rgb(10.f)), true);
  write("b.dlm", bake(0, 6, s.build()));
  expectError([&] { compared(); }, ExitCode::badInput, "of different scenes");
  const std::filesystem::path a = folder_ / "a.dlm";
  expectError([&] { compare({a, a, {}, 1, {}, {}, 0.1}); }, ExitCode::usage, "--max-flip is for pictures");
  expectError([&] { compare({a, a, folder_ / "d.png", 1, {}, {}, {}}); }, ExitCode::usage, "--picture is for pictures");
  expectError([&] { compare({a, folder_ / "c.dlm", {}, 1, {}, {}, {}}); }, ExitCode::badInput, "no such file");
}

TEST_F(CompareMaps, TextSaysWhatJsonSays) {
  write("a.dlm", bake(1));
  write("b.dlm", bake(2));
  const std::string text = compareText(compared());
  for (const char* words : {"light maps", "RMSE", "relative error", "largest difference", "by direction", "times A"}) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace lucarne::compare_maps_test
