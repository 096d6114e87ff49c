// Both renderers make the same picture of every scene that is here and small enough to be baked in passing.
#include <filesystem>

#include "app/bake.h"
#include "base/log.h"
#include "dlm/dlm_reader.h"
#include "player/camera_choice.h"
#include "player/offscreen.h"
#include "tests/base/temp_folder.h"
#include "tests/player/gl_available.h"

namespace lucarne::scenes_agree_test {
namespace {

namespace fs = std::filesystem;

struct SceneFile {
  std::string name;
  fs::path path;
};

constexpr std::uintmax_t kLargest = 500'000;  // bytes

std::vector<SceneFile> sceneFiles() {
  std::vector<SceneFile> files;
  for (const char* folder : {LUCARNE_SOURCE_DIR "/scenes", LUCARNE_SOURCE_DIR "/../shared/assets/scenes"}) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".glb" && entry.file_size() < kLargest) files.push_back({entry.path().stem().string(), entry.path()});
    }
  }
  std::sort(files.begin(), files.end(), [](const SceneFile& a, const SceneFile& b) { return a.name < b.name; });
  return files;
}

class ScenesAgree : public test::GlTest, public ::testing::WithParamInterface<SceneFile> {};

TEST_P(ScenesAgree, ToAThousandthOfTheMean) {
  setQuiet(true);
  TempFolder folder;
  BakeOptions bakeOptions;
  bakeOptions.scene = GetParam().path;
  bakeOptions.output = folder / "scene.dlm";
  bakeOptions.photons = 20'000;
  bakeOptions.texelBudget = 20'000;
  bakeOptions.guidedEmission = false;
  bake(bakeOptions);
  const Dlm dlm = readDlm(bakeOptions.output);
  const Camera camera = chooseCamera(dlm.scene, "");
  const auto picture = [&](RendererKind kind) {
    return renderImage(dlm.scene, dlm.maps, camera, {64, 48, kind, LightMapFormat::float32});
  };
  const ImageRgb single = picture(RendererKind::singlepass), multi = picture(RendererKind::multipass);
  double sum = 0, worst = 0;
  for (std::size_t i = 0; i < single.pixels.size(); ++i) {
    const Rgb d = single.pixels[i] - multi.pixels[i];
    sum += mean(single.pixels[i]);
    worst = std::max<double>(worst, std::max(maxComponent(d), -minComponent(d)));
  }
  if (sum == 0) GTEST_SKIP() << "no light in sight";
  EXPECT_LT(worst, 1e-3 * sum / static_cast<double>(single.pixels.size()));
}

INSTANTIATE_TEST_SUITE_P(Files, ScenesAgree, ::testing::ValuesIn(sceneFiles()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace lucarne::scenes_agree_test
