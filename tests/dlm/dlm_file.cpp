#include <cstring>

#include "base/files.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"
#include "tests/dlm/dlm_file_fixture.h"

namespace lucarne::dlm_file_test {
namespace {

using test::BakedScene;
using test::smallBakedScene;

void expectSameStructure(const LightMaps& a, const LightMaps& b) {
  EXPECT_EQ(a.directionCount, b.directionCount);
  EXPECT_EQ(a.atlasWidth, b.atlasWidth);
  EXPECT_EQ(a.atlasHeight, b.atlasHeight);
  ASSERT_EQ(a.charts.size(), b.charts.size());
  for (std::size_t i = 0; i < a.charts.size(); ++i) {
    const MapChart &p = a.charts[i], &q = b.charts[i];
    EXPECT_EQ(std::tie(p.material, p.smooth, p.planar, p.texelSize, p.frontSide, p.backSide),
              std::tie(q.material, q.smooth, q.planar, q.texelSize, q.frontSide, q.backSide));
    EXPECT_EQ(p.normal, q.normal);
    EXPECT_EQ(std::tie(p.atlasX, p.atlasY, p.width, p.height), std::tie(q.atlasX, q.atlasY, q.width, q.height));
  }
  ASSERT_EQ(a.sides.size(), b.sides.size());
  for (std::size_t i = 0; i < a.sides.size(); ++i) {
    const SideMaps &p = a.sides[i], &q = b.sides[i];
    EXPECT_EQ(std::tie(p.chart, p.back, p.lit, p.width, p.height, p.firstTexel),
              std::tie(q.chart, q.back, q.lit, q.width, q.height, q.firstTexel));
    ASSERT_EQ(p.directions.size(), q.directions.size());
    for (std::size_t k = 0; k < p.directions.size(); ++k) {
      EXPECT_EQ(p.directions[k].psi, q.directions[k].psi);
      EXPECT_EQ(p.directions[k].first, q.directions[k].first);
    }
  }
}

void expectSameIrradiance(const LightMaps& a, const LightMaps& b) {
  EXPECT_EQ(a.irradiance, b.irradiance);
  EXPECT_EQ(a.photons, b.photons);
  EXPECT_EQ(a.relativeError, b.relativeError);
  EXPECT_EQ(a.standardError, b.standardError);
}

void expectDirectionalWithinHalf(const LightMaps& a, const LightMaps& b) {
  ASSERT_EQ(a.directional.size(), b.directional.size());
  for (std::size_t i = 0; i < a.directional.size(); ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b.directional[i][c], a.directional[i][c], a.directional[i][c] * 0x1p-11f);
  }
}

TEST(DlmFile, FloatRoundTripIsExact) {
  const TempFolder folder;
  const BakedScene scene = smallBakedScene();
  for (const ExrCompression compression : {ExrCompression::none, ExrCompression::rle, ExrCompression::zips}) {
    scene.write(folder / "room.dlm", {MapFormat::float32, compression});
    const Dlm dlm = readDlm(folder / "room.dlm");
    expectSameStructure(scene.maps(), dlm.maps);
    expectSameIrradiance(scene.maps(), dlm.maps);
    EXPECT_EQ(scene.maps().directional, dlm.maps.directional);
    EXPECT_EQ(dlm.scene.triangles.size(), 7u);
    EXPECT_EQ(dlm.scene.chartOfTriangle, scene.uv().chartOfTriangle);
  }
}

TEST(DlmFile, HalfRoundTripKeepsElevenBitsAtEveryBrightness) {
  const TempFolder folder;
  for (const float brightness : {1e-12f, 1e-6f, 1.f, 1e6f, 1e12f, 1e30f}) {
    const BakedScene scene = smallBakedScene(brightness);
    scene.write(folder / "room.dlm");
    const Dlm dlm = readDlm(folder / "room.dlm");
    expectSameStructure(scene.maps(), dlm.maps);
    expectSameIrradiance(scene.maps(), dlm.maps);
    expectDirectionalWithinHalf(scene.maps(), dlm.maps);
  }
}

TEST(DlmFile, NormalsAndSizesThatAreNoShortDecimalsComeBackExactly) {
  const TempFolder folder;
  BakedScene scene = smallBakedScene();
  scene.builder.addQuad({1, 1, 4}, {1, 2, 5}, {2, 3, 5}, {2, 2, 4}, 1);
  scene.addChart(1, normalize(Vec3f{1, 2, 3}), 1, 1, 14, 7, 1.0 / 3).smooth = true;
  scene.addSide(false, [](int, int) { return Rgb{0.1f, 1.f / 3, 1e-20f}; });
  expectSameStructure(scene.maps(), scene.reread(folder / "room.dlm").maps);
}

TEST(DlmFile, ProvenanceIsKeptAndTheManifestsOwnKeysWin) {
  const TempFolder folder;
  smallBakedScene().write(folder / "room.dlm", {},
                          {{"content_hash", "abc"}, {"settings", {{"seed", 7}}}, {"version", 99}, {"charts", nullptr}});
  const Dlm dlm = readDlm(folder / "room.dlm");
  EXPECT_EQ(dlm.manifest["content_hash"], "abc");
  EXPECT_EQ(dlm.manifest["settings"]["seed"], 7);
  EXPECT_EQ(dlm.manifest["version"], 1);
  EXPECT_EQ(dlm.manifest["charts"]["count"], 3);
}

TEST(DlmFile, ProvenanceNeedNotBeUtf8) {
  const TempFolder folder;
  smallBakedScene().write(folder / "room.dlm", {}, {{"scene", "r\xe9sum\xe9.glb"}});
  EXPECT_TRUE(readDlm(folder / "room.dlm").manifest["scene"].is_string());
}

TEST(DlmFile, AManifestReadServesAsProvenanceOfTheNext) {
  const TempFolder folder;
  const BakedScene scene = smallBakedScene();
  scene.write(folder / "a.dlm", {}, {{"content_hash", "abc"}});
  const Dlm a = readDlm(folder / "a.dlm");
  scene.write(folder / "b.dlm", {}, a.manifest);
  EXPECT_EQ(readDlm(folder / "b.dlm").manifest, a.manifest);
}

TEST(DlmFile, SameInputGivesTheSameBytes) {
  const TempFolder folder;
  smallBakedScene().write(folder / "a.dlm");
  smallBakedScene().write(folder / "b.dlm");
  for (const char* name : {"manifest.json", "irradiance.exr", "directional.exr"}) {
    EXPECT_EQ(readFile(folder / "a.dlm" / name), readFile(folder / "b.dlm" / name)) << name;
  }
}

// Any engine that samples the first layer with uv1 sees the front's light, bilinear lookup up to the charts' edges
// included.
TEST(DlmFile, IrradianceIsAnOrdinaryLightMapWithFilledGutters) {
  const TempFolder folder;
  const BakedScene scene = smallBakedScene();
  scene.write(folder / "room.dlm");
  const ImageRgb image = readExrRgb(folder / "room.dlm" / "irradiance.exr");
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.height, 12);
  const LightMaps& maps = scene.maps();
  for (const std::uint32_t c : {0u, 1u}) {
    const MapChart& chart = maps.charts[c];
    const SideMaps& side = maps.sides[chart.frontSide];
    for (int y = -1; y <= chart.height; ++y) {
      for (int x = -1; x <= chart.width; ++x) {
        const int tx = std::clamp(x, 0, chart.width - 1), ty = std::clamp(y, 0, chart.height - 1);
        const auto texel = side.firstTexel + static_cast<std::size_t>(ty * side.width + tx);
        const auto pixel = static_cast<std::size_t>((chart.atlasY + y) * image.width + chart.atlasX + x);
        EXPECT_EQ(image.pixels[pixel], maps.irradiance[texel]) << c << " " << x << " " << y;
      }
    }
  }
}

TEST(DlmFile, LayersAreNamedBySideAndDirection) {
  const TempFolder folder;
  smallBakedScene().write(folder / "room.dlm");
  std::vector<std::string> names;
  for (const ExrLayer& layer : readExr(folder / "room.dlm" / "irradiance.exr")) names.push_back(layer.name);
  EXPECT_EQ(names, (std::vector<std::string>{"front", "front.statistics", "back", "back.statistics"}));
  names.clear();
  const std::vector<ExrLayer> layers = readExr(folder / "room.dlm" / "directional.exr");
  for (const ExrLayer& layer : layers) {
    names.push_back(layer.name);
    EXPECT_EQ(layer.width, layers[0].width);
    EXPECT_EQ(layer.height, layers[0].height);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"psi 000 page 0", "psi 001 page 0", "psi 013 page 0"}));
}

TEST(DlmFile, DirectionalMapsHaveAGutterOfTheirBorder) {
  const TempFolder folder;
  const BakedScene scene = smallBakedScene();
  scene.write(folder / "room.dlm", {MapFormat::float32, ExrCompression::none});
  const std::vector<ExrLayer> layers = readExr(folder / "room.dlm" / "directional.exr");
  const nlohmann::json manifest = readManifest(folder / "room.dlm");
  const int width = layers[0].width;
  const int place = manifest["sides"]["place"][0];
  const int left = place % width, top = place / width % layers[0].height;
  const SideMaps& side = scene.maps().sides[0];
  for (int y = -1; y <= side.height; ++y) {
    for (int x = -1; x <= side.width; ++x) {
      const int tx = std::clamp(x, 0, side.width - 1), ty = std::clamp(y, 0, side.height - 1);
      const Rgb& expected = scene.maps().directional[static_cast<std::size_t>(ty * side.width + tx)];
      EXPECT_EQ(layers[0].find("G")->floats[static_cast<std::size_t>((top + y) * width + left + x)], expected.y);
    }
  }
}

TEST(DlmFile, WithoutDirectionsThereIsNoDirectionalFile) {
  const TempFolder folder;
  BakedScene scene(14);
  scene.builder.addDiffuse(Rgb{0.8f});
  scene.builder.addQuad({0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}, 0);
  scene.addChart(0, {0, 1, 0}, 4, 3, 1, 1, 1);
  scene.addSide(false, [](int x, int) { return Rgb{static_cast<float>(x)}; });
  scene.addEmptyDirection(3);
  scene.setAtlas(8, 8);
  expectSameStructure(scene.maps(), scene.reread(folder / "room.dlm").maps);
  EXPECT_FALSE(std::filesystem::exists(folder / "room.dlm" / "directional.exr"));
}

TEST(DlmFile, SetsOfThousandsOfDirectionsShareLayers) {
  const TempFolder folder;
  constexpr int kCount = 4096;
  BakedScene scene(kCount);
  scene.builder.addDiffuse(Rgb{0.8f});
  scene.builder.addQuad({0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}, 0);
  scene.addChart(0, {0, 1, 0}, 2, 1, 1, 1, 2);
  scene.addSide(false, [](int x, int) { return Rgb{static_cast<float>(x)}; });
  for (int psi = 0; psi < kCount; ++psi) {
    scene.addDirection(psi, [&](int x, int) { return Rgb{static_cast<float>(psi + x)}; });
  }
  scene.setAtlas(4, 4);
  const Dlm dlm = scene.reread(folder / "room.dlm");
  expectSameStructure(scene.maps(), dlm.maps);
  EXPECT_EQ(scene.maps().directional, dlm.maps.directional);
  EXPECT_LE(dlm.manifest["directional"]["layers"].size(), 2048u);
}

TEST(DlmFile, ReplacesAnEarlierOneWhole) {
  const TempFolder folder;
  smallBakedScene().write(folder / "room.dlm");
  writeFileAtomically(folder / "room.dlm" / "left-over.txt", std::string("x"));
  smallBakedScene(2).write(folder / "room.dlm");
  EXPECT_FALSE(std::filesystem::exists(folder / "room.dlm" / "left-over.txt"));
  expectSameIrradiance(smallBakedScene(2).maps(), readDlm(folder / "room.dlm").maps);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(DlmFile, DoesNotReplaceWhatIsNotOurs) {
  const TempFolder folder;
  const std::filesystem::path path = folder / "room.dlm";
  std::filesystem::create_directory(path);
  for (const char* content : {"precious", "{\"format\": \"other\"}", "[1]", "\"lucarne-dlm\"", ""}) {
    writeFileAtomically(path / "manifest.json", std::string(content));
    EXPECT_FALSE(holdsLightMaps(path));
    const std::string text = errorOf(ExitCode::failed, [&] { smallBakedScene().write(path); });
    EXPECT_NE(text.find("room.dlm"), std::string::npos);
    EXPECT_EQ(readFile(path / "manifest.json").size(), std::strlen(content));
  }
  std::filesystem::remove(path / "manifest.json");
  errorOf(ExitCode::failed, [&] { smallBakedScene().write(path); });  // an empty folder may be someone's too
  std::filesystem::remove(path);
  writeFileAtomically(path, std::string("a file"));
  errorOf(ExitCode::failed, [&] { smallBakedScene().write(path); });
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(DlmFile, BrokenMapsAreRefusedBeforeAnythingIsWritten) {
  const TempFolder folder;
  const BakedScene good = smallBakedScene();
  const auto expectRefused = [&](auto spoil) {
    LightMaps maps = good.maps();
    spoil(maps);
    EXPECT_THROW(writeDlm(folder / "x.dlm", good.builder.build(), good.uv(), maps, nlohmann::json::object()),
                 std::logic_error);
  };
  expectRefused([](LightMaps& m) { m.irradiance.pop_back(); });
  expectRefused([](LightMaps& m) { m.irradiance[3].y = std::nanf(""); });
  expectRefused([](LightMaps& m) { m.directional[3].y = HUGE_VALF; });
  expectRefused([](LightMaps& m) { m.directional.pop_back(); });
  expectRefused([](LightMaps& m) { m.sides[0].width = 5; });
  expectRefused([](LightMaps& m) { m.charts[0].frontSide = 1; });
  expectRefused([](LightMaps& m) { m.charts[2].atlasX = 16; });
  expectRefused([](LightMaps& m) { m.sides[0].directions[0].psi = 14; });
  EXPECT_EQ(folder.entries(), 0u);
}

}  // namespace
}  // namespace lucarne::dlm_file_test
