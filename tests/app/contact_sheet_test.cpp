#include "app/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/sheet_exposure.h"
#include "app/sheet_panel.h"
#include "tests/app/bake_fixture.h"
#include "tests/base/expect_error.h"
#include "tests/base/temp_folder.h"

namespace lucarne::contact_sheet_test {
namespace {

/// A floor lit by a red lamp, its material glossy so that it has directions.
Dlm floorDlm(const std::filesystem::path& folder, int directions, bool doubleSided) {
  test::SceneBuilder s;
  Material glossy = test::diffuseMaterial(Rgb(0.3f));
  glossy.specular = 1;
  glossy.roughness = 0.4f;
  glossy.doubleSided = doubleSided;
  s.addMaterial(glossy);
  s.addQuad({0, 0, 0}, {0, 0, 2}, {3, 0, 2}, {3, 0, 0}, 0);
  const auto lamp = s.addDiffuse(Rgb(0.5f), Rgb(100.f, 0.f, 0.f));
  s.addQuad({1, 2, 1}, {2, 2, 1}, {2, 2, 1.5}, {1, 2, 1.5}, lamp);
  if (doubleSided) s.addQuad({1, -2, 1.5}, {2, -2, 1.5}, {2, -2, 1}, {1, -2, 1}, lamp);
  BakeOptions o = test::quickOptions(100'000, 8);
  o.directions = directions;
  const test::BakedScene b(s.build(), o);
  writeDlm(folder, b.scene, b.baked.uv, b.baked.maps, {{"photons", 100'000}}, {});
  return readDlm(folder);
}

int countWhere(const Canvas& canvas, bool (*matches)(DisplayColour)) {
  int n = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) n += matches(canvas.at(x, y));
  }
  return n;
}

bool isRed(DisplayColour c) { return c[0] > 60 && c[1] < 20 && c[2] < 20; }

TEST(ContactSheet, ShowsTheColourOfTheLight) {
  const TempFolder folder;
  const Dlm dlm = floorDlm(folder / "a.dlm", 14, false);
  EXPECT_GT(countWhere(contactSheet(dlm, "a.dlm"), isRed), 2000);
}

TEST(ContactSheet, IsNoLargerForThousandsOfDirectionsAndLargerForBacks) {
  const TempFolder folder;
  const Canvas few = contactSheet(floorDlm(folder / "a.dlm", 14, false), "a.dlm");
  const Canvas many = contactSheet(floorDlm(folder / "b.dlm", 1024, false), "b.dlm");
  const Canvas backs = contactSheet(floorDlm(folder / "c.dlm", 14, true), "c.dlm");
  EXPECT_EQ(few.width(), many.width());
  EXPECT_GT(many.height(), few.height());
  EXPECT_LT(many.height(), 4000);
  EXPECT_GT(backs.height(), few.height());
}

TEST(ContactSheet, GridsAverageLargeAtlasesAndKeepSmallOnes) {
  LightMaps maps;
  maps.atlasWidth = 40, maps.atlasHeight = 20;
  MapChart chart;
  chart.atlasX = 10, chart.atlasY = 4, chart.width = 8, chart.height = 4;
  const auto value = [](std::uint64_t t) { return Vec3d(static_cast<double>(t)); };
  AtlasGrid exact(maps, 64);
  exact.addSide(chart, value);
  EXPECT_EQ(exact.width(), 40);
  EXPECT_FALSE(exact.covered(9, 4));
  EXPECT_EQ(exact.mean(17, 7).x, 31);
  AtlasGrid halved(maps, 20);
  halved.addSide(chart, value);
  EXPECT_EQ(halved.height(), 10);
  EXPECT_EQ(halved.mean(5, 2).x, (0 + 1 + 8 + 9) / 4.0);
}

TEST(ContactSheet, GreyIsShownGreyAndWhiteWhiteAtEveryScale) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    std::vector<double> l;
    for (int i = 1; i <= 1000; ++i) l.push_back(scale * i);
    const SheetExposure exposure(l);
    const DisplayColour white = exposure(Rgbd(1000 * scale)), grey = exposure(Rgbd(380 * scale)), black = exposure({});
    EXPECT_EQ(white, (DisplayColour{255, 255, 255}));
    EXPECT_GT(grey[0], 80);
    EXPECT_LT(grey[0], 160);
    EXPECT_EQ(black, (DisplayColour{0, 0, 0}));
  }
  EXPECT_EQ(SheetExposure({})(Rgbd(0.)), (DisplayColour{0, 0, 0}));
}

TEST(ContactSheet, OfAnythingElseIsRefused) {
  const TempFolder folder;
  floorDlm(folder / "a.dlm", 1, false);
  EXPECT_NE(errorOf(ExitCode::usage, [&] { writeContactSheet(folder / "a.dlm", folder / "a.jpg"); }).find("a .png"),
            std::string::npos);
  EXPECT_NE(errorOf(ExitCode::badInput, [&] { writeContactSheet(folder / "no.dlm", folder / "a.png"); }).find("no.dlm"),
            std::string::npos);
  writeContactSheet(folder / "a.dlm", folder / "a.png");
  EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace lucarne::contact_sheet_test
