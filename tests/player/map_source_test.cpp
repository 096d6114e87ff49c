// Light maps that go from their file to the GPU page by page are those that go through memory.
#include "player/map_source.h"

#include "app/bake_scene.h"
#include "dlm/dlm_writer.h"
#include "player/map_tables.h"
#include "player/offscreen.h"
#include "player/shown_scene.h"
#include "tests/base/temp_folder.h"
#include "tests/player/gl_available.h"
#include "tests/support/scene_builder.h"

namespace lucarne::map_source_test {
namespace {

void ignore(const std::string&, double) {}

/// A room with a coloured wall, so that there are neutral maps and coloured ones.
class DlmShown : public test::GlTest {
 protected:
  DlmShown() {
    test::SceneBuilder b;
    b.addBox({0, 0, 0}, {4, 3, 4}, b.addDiffuse(Rgb(0.5f), Rgb(1.f)), true);
    Material red;
    red.baseColor = {0.9f, 0.2f, 0.1f};
    red.roughness = 0.3f;
    b.addBox({1, 0.2, 2}, {2, 1, 3}, b.addMaterial(red));
    b.addCamera({0.5, 1.5, 0.5}, {2, 0.7, 3});
    scene_ = b.build();
    options_.photons = 20000;
    options_.directions = 30;
    options_.texelsPerMetre = 4;
    options_.keepAllDirections = true;
    const PhotonScene photonScene(scene_);
    const BakePlan plan = makePlan(scene_, options_);
    baked_ = bakeScene(photonScene, plan, options_, [](const RunProgress&) { return true; });
  }

  void write(MapFormat format) { writeDlm(path_, scene_, baked_.uv, baked_.maps, {{"photons", 20000}}, {format}); }

  static ImageRgb pictureOf(const Dlm& dlm, const RenderOptions& options) {
    return renderImage(dlm.scene, dlm.maps, dlm.scene.cameras.at(0), options);
  }

  TempFolder folder_;
  std::filesystem::path path_ = folder_ / "a.dlm";
  Scene scene_;
  BakeOptions options_;
  Baked baked_;
};

TEST_F(DlmShown, IsTheSameFromTheFileAsFromMemory) {
  for (const MapFormat file : {MapFormat::half, MapFormat::rgb9e5, MapFormat::float32, MapFormat::ldr8}) {
    write(file);
    const Dlm dlm = readDlm(path_);
    for (const LightMapFormat gpu : {LightMapFormat::half, LightMapFormat::rgb9e5, LightMapFormat::float32}) {
      for (const RendererKind renderer : {RendererKind::singlepass, RendererKind::multipass}) {
        const RenderOptions options{64, 48, renderer, gpu};
        OpenedDlm opened = openDlm(path_, ignore);
        const ImageRgb streamed = renderImage(opened, dlm.scene.cameras.at(0), options);
        EXPECT_EQ(opened.directional.has_value(), file == MapFormat::half || file == MapFormat::rgb9e5);
        EXPECT_EQ(streamed.pixels, pictureOf(dlm, options).pixels) << nameOf(file) << " " << static_cast<int>(gpu);
      }
    }
  }
}

TEST_F(DlmShown, LosesDirectionsWhereMemoryIsShort) {
  write(MapFormat::half);
  const Dlm dlm = readDlm(path_);
  RenderOptions options{64, 48, RendererKind::singlepass, LightMapFormat::half};
  options.gpuMemory = mapTextureBytes(dlm.maps, LightMapFormat::rgb9e5, {16384, 2048}) / 2;
  OpenedDlm opened = openDlm(path_, ignore);
  RenderStats stats;
  const ImageRgb image = renderImage(opened, dlm.scene.cameras.at(0), options, &stats);
  EXPECT_LT(stats.directions, 30);
  EXPECT_EQ(image.pixels, pictureOf(dlm, options).pixels);
}

TEST_F(DlmShown, LightByDirectionIsReadBackFromTheGpu) {
  write(MapFormat::half);
  const Dlm dlm = readDlm(path_);
  const HeadlessGl gl;
  const auto shown = loadScene({path_, ""}, ignore);
  ASSERT_TRUE(shown->dlm().maps.directional.empty());
  const Inspector inMemory(dlm.scene, dlm.maps), onGpu(shown->dlm().scene, shown->dlm().maps, shown->lightByDirection());
  std::size_t compared = 0;
  for (const Vec2d at : {Vec2d{0.5, 0.5}, Vec2d{0.1, 0.9}, Vec2d{0.9, 0.2}, Vec2d{0.5, 0.95}}) {
    const auto a = inMemory.inspect(dlm.scene.cameras[0], at.x, at.y, 1.5), b = onGpu.inspect(dlm.scene.cameras[0], at.x, at.y, 1.5);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ASSERT_EQ(a->answer.directions.size(), b->answer.directions.size());
    for (std::size_t i = 0; i < a->answer.directions.size(); ++i, ++compared) {
      const Rgbd x = a->answer.directions[i].irradiance, y = b->answer.directions[i].irradiance;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[c], y[c], 1e-6 * (1 + x[c]));
    }
  }
  EXPECT_GT(compared, 30u);
}

TEST_F(DlmShown, ADamagedFileIsRefused) {
  write(MapFormat::half);
  const HeadlessGl gl;
  std::filesystem::resize_file(path_ / "directional.exr", std::filesystem::file_size(path_ / "directional.exr") - 50);
  EXPECT_THROW(loadScene({path_, ""}, ignore), InputError);
}

}  // namespace
}  // namespace lucarne::map_source_test
