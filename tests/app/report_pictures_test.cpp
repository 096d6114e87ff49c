// Pictures for the page: by the player where it can, else traced, and what is missing is said.
#include "app/report_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/app/bake_fixture.h"
#include "tests/base/temp_folder.h"

namespace lucarne::report_pictures_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A lit room with so many cameras, baked, and its light maps as they come back from disk.
struct LitRoom {
  explicit LitRoom(int cameras, const TempFolder& folder) : baked(build(cameras), test::quickOptions(20'000, 4)) {
    writeDlm(folder / "a.dlm", baked.scene, baked.baked.uv, baked.baked.maps, {{"photons", 20'000}}, {});
    dlm = readDlm(folder / "a.dlm");
  }
  static Scene build(int cameras) {
    test::SceneBuilder s;
    s.addDiffuse(Rgb{0.5f});
    s.addBox({0, 0, 0}, {2, 2, 2}, 0, true);
    const auto lamp = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
    s.addQuad({0.8, 1.9, 0.8}, {1.2, 1.9, 0.8}, {1.2, 1.9, 1.2}, {0.8, 1.9, 1.2}, lamp);
    for (int i = 0; i < cameras; ++i) s.addCamera({1, 1, 1.8}, {1, 1, 0});
    return s.build();
  }
  ReportPictures pictures(const PlayerPictures& player, bool light = true, bool maps = true,
                          double seconds = 1e6) const {
    BakeOptions options;
    options.threads = 2;
    return reportPictures(
        {options, light ? &baked.photonScene : nullptr, maps ? &dlm : nullptr, maps ? &dlm.maps : nullptr, seconds},
        player);
  }

  test::BakedScene baked;
  Dlm dlm;
};

/// Paints one colour, and counts.
PlayerPictures painter(int& calls) {
  return {[&calls](const Dlm&, const Camera&, int width, int height, std::string& driver) {
            ++calls;
            driver = "a brush";
            ImageRgb image{width, height, {}};
            image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Rgb{1.f});
            return image;
          },
          {}};
}

PlayerPictures brokenPlayer() {
  return {[](const Dlm&, const Camera&, int, int, std::string&) -> ImageRgb {
            throw Error(ExitCode::failed, "no OpenGL 4.5");
          },
          {}};
}

TEST(ReportPictures, AreThePlayersWhereItCanDraw) {
  const TempFolder folder;
  int calls = 0;
  const ReportPictures p = LitRoom(2, folder).pictures(painter(calls));
  EXPECT_EQ(calls, 2);
  ASSERT_THAT(p.cameras, SizeIs(2));
  EXPECT_THAT(p.cameras[1].title, HasSubstr("camera 1 'camera1'"));
  EXPECT_THAT(p.cameras[1].how, HasSubstr("by the player (a brush)"));
  const DecodedImage image = decodeImage(p.cameras[1].png, "picture");
  EXPECT_EQ(image.width, p.cameras[1].width);
  EXPECT_EQ(image.height, p.cameras[1].height);
  EXPECT_THAT(p.notes, IsEmpty());
  ASSERT_THAT(p.maps, SizeIs(1));
  EXPECT_THAT(p.maps[0].how, HasSubstr("colours 0 to "));
}

TEST(ReportPictures, AreTracedWhereItCannotAndSaySo) {
  const TempFolder folder;
  const LitRoom room(1, folder);
  const ReportPictures p = room.pictures(brokenPlayer(), true, true, 0);
  ASSERT_THAT(p.cameras, SizeIs(1));
  EXPECT_THAT(p.cameras[0].how, HasSubstr("path traced without light maps, 1 path a pixel")) << "in no time";
  ASSERT_THAT(p.notes, SizeIs(1));
  EXPECT_THAT(p.notes[0], HasSubstr("no OpenGL 4.5"));
  const DecodedImage image = decodeImage(p.cameras[0].png, "picture");
  double sum = 0;
  for (const std::uint8_t byte : image.rgba) sum += byte;
  EXPECT_GT(sum / static_cast<double>(image.rgba.size()), 80) << "more than the alpha: it is lit";
}

TEST(ReportPictures, OfManyCamerasAreEight) {
  const TempFolder folder;
  int calls = 0;
  const ReportPictures p = LitRoom(11, folder).pictures(painter(calls));
  EXPECT_THAT(p.cameras, SizeIs(8));
  EXPECT_THAT(p.notes, testing::ElementsAre("of 11 cameras the first 8"));
}

TEST(ReportPictures, ThatCannotBeAreNamed) {
  const TempFolder folder;
  int calls = 0;
  const LitRoom none(0, folder);
  EXPECT_THAT(none.pictures(painter(calls)).notes, testing::Contains("the scene has no camera"));
  const LitRoom one(1, folder);
  const ReportPictures p = one.pictures(brokenPlayer(), false);
  EXPECT_THAT(p.cameras, IsEmpty());
  const ReportPictures part = one.pictures(painter(calls), true, false, 0);
  EXPECT_THAT(part.maps, IsEmpty());
  ASSERT_THAT(part.cameras, SizeIs(1)) << "traced: there are no light maps to draw";
  EXPECT_THAT(part.notes, testing::Contains("no error map: no light maps were made"));
}

}  // namespace
}  // namespace lucarne::report_pictures_test
