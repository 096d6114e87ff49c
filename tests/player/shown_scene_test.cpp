// Loading beside the window: told step by step, and ended at any of them.
#include "player/shown_scene.h"

#include <unistd.h>

#include "app/bake_scene.h"
#include "dlm/dlm_writer.h"
#include "tests/player/gl_available.h"
#include "tests/support/scene_builder.h"

namespace lucarne::shown_scene_test {
namespace {

namespace fs = std::filesystem;

class SceneShown : public test::GlTest {
 protected:
  SceneShown() : folder_(fs::path(testing::TempDir()) / ("lucarne_shown_" + std::to_string(::getpid()) + ".dlm")) {
    test::SceneBuilder b;
    b.addBox({0, 0, 0}, {4, 3, 4}, b.addDiffuse(Rgb(0.5f), Rgb(1.f)), true);
    b.addCamera({1, 1.5, 1}, {3, 1, 3});
    const Scene scene = b.build();
    BakeOptions o;
    o.photons = 2000;
    o.texelsPerMetre = 2;
    const PhotonScene photonScene(scene);
    const BakePlan plan = makePlan(scene, o);
    const Baked baked = bakeScene(photonScene, plan, o, [](const RunProgress&) { return true; });
    writeDlm(folder_, scene, baked.uv, baked.maps, {{"photons", 2000}});
  }
  ~SceneShown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(SceneShown, TellsItsStepsInOrder) {
  const HeadlessGl gl;
  std::vector<double> shares;
  const auto shown = loadScene({folder_, ""}, [&](const std::string& step, double share) {
    EXPECT_FALSE(step.empty());
    shares.push_back(share);
  });
  EXPECT_GE(shares.size(), 5u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GE(shares.front(), 0);
  EXPECT_LT(shares.back(), 1);
  EXPECT_EQ(shown->photons, 2000);
  EXPECT_EQ(shown->walk->cameras.size(), 1u);
  EXPECT_EQ(gl.messages().errors, 0u);
}

TEST_F(SceneShown, EndsAtAnyStep) {
  struct Stop {};
  const HeadlessGl gl;
  int steps = 0;
  loadScene({folder_, ""}, [&](const std::string&, double) { ++steps; });
  for (int last = 0; last < steps; ++last) {
    int step = 0;
    const auto stop = [&](const std::string&, double) {
      if (step++ == last) throw Stop();
    };
    EXPECT_THROW(loadScene({folder_, ""}, stop), Stop) << last;
  }
  EXPECT_EQ(gl.messages().errors, 0u);
}

TEST_F(SceneShown, WrongCamerasAndSpoiledMapsAreRefused) {
  const HeadlessGl gl;
  const auto ignore = [](const std::string&, double) {};
  EXPECT_THROW(loadScene({folder_, "nobody"}, ignore), Error);
  fs::resize_file(folder_ / "irradiance.exr", 100);
  EXPECT_THROW(loadScene({folder_, ""}, ignore), Error);
}

}  // namespace
}  // namespace lucarne::shown_scene_test
