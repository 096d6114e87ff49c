// The error that ends a bake is the one that its report tells.
#include <gtest/gtest.h>

#include "app/bake_scene.h"
#include "distributed/direct_run.h"
#include "tests/support/scene_builder.h"

namespace lucarne::error_estimate_test {
namespace {

Scene room() {
  test::SceneBuilder s;
  Material glossy = test::diffuseMaterial({0.3f, 0.2f, 0.1f});
  glossy.specular = 1;
  glossy.roughness = 0.4f;
  glossy.doubleSided = true;
  s.addBox({0, 0, 0}, {4, 3, 5}, s.addDiffuse({0.8f, 0.7f, 0.6f}), true);
  s.addBox({1, 0, 1}, {2, 1, 2.5}, s.addMaterial(glossy), false);  // on the floor: contacts
  s.addBox({1.5, 2.5, 2}, {2.5, 2.6, 3}, s.addDiffuse(Rgb(0.1f), {900, 700, 500}), false);
  return s.build();
}

class ErrorEstimate : public ::testing::TestWithParam<KernelShape> {
 protected:
  /// The estimate of a bake, and what is found in the maps that it makes.
  static std::pair<double, double> both(BakeOptions o, std::uint64_t photons, std::uint64_t samples) {
    o.texelsPerMetre = 4;
    o.kernel.shape = GetParam();
    o.kernel.width = defaultKernelWidth(o.kernel.shape);
    const Scene scene = room();
    const PhotonScene photonScene(scene);
    const BakePlan plan = makePlan(scene, o);
    Tallies tallies(plan.tallies, tallySets(o));
    Ledger ledger;
    if (gathersDirect(o)) {
      const DirectGather gather({photonScene, plan.charts, plan.layout, plan.tallies, plan.directions},
                                {o.seed, o.sampler});
      DirectRun(gather, 2, tallies).gather({0, samples}, [] { return true; });
    }
    const TexelMap map(scene, plan.charts, plan.layout, plan.tallies);
    runPhotons({photonScene, map, plan.tallies, plan.directions}, {0, photons}, runOptions(o), tallies, ledger,
               [](const RunProgress&) { return true; });
    const auto contacts = findContacts(scene, plan.charts, plan.layout, plan.tallies, photonScene.rayCaster(),
                                       makeKernel(o.kernel).radius);
    const ResolveInput in{scene,
                          plan.charts,
                          plan.layout,
                          plan.tallies,
                          tallies,
                          o.directions,
                          photonScene.emitters().totalFlux(),
                          ledger.photons,
                          samples,
                          samples / 2,
                          contacts};
    const double estimate = estimateRelativeError(in, o.kernel);
    EXPECT_EQ(estimate, estimateRelativeError(in, o.kernel)) << "the same bits again";
    return {estimate, estimatedRelativeError(resolve(in, o.kernel), plan.layout)};
  }
};

TEST_P(ErrorEstimate, IsThatOfTheMaps) {
  const auto [estimate, truth] = both({}, 100'000, 0);
  EXPECT_GT(truth, 0.01);
  EXPECT_NEAR(estimate, truth, 1e-5 * truth);
}

TEST_P(ErrorEstimate, IsThatOfTheMapsWithGatheredLight) {
  BakeOptions o;
  o.kernel = {};
  o.direct = DirectMode::gathered;
  const auto [estimate, truth] = both(o, 50'000, 8);
  EXPECT_GT(truth, 0.001);
  EXPECT_NEAR(estimate, truth, 1e-5 * truth);
}

INSTANTIATE_TEST_SUITE_P(Kernels, ErrorEstimate, testing::Values(KernelShape::pyramid, KernelShape::adaptive),
                         [](const auto& kernel) {
                           return kernel.param == KernelShape::pyramid ? "pyramid" : "adaptive";
                         });

}  // namespace
}  // namespace lucarne::error_estimate_test
