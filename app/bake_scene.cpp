#include "app/bake_scene.h"

#include <chrono>

#include "base/system.h"
#include "dlm/resolve.h"

namespace lucarne {

int threadCount(const BakeOptions& options) {
  return options.threads > 0 ? options.threads : threadCount();
}

BakePlan makePlan(const Scene& scene, const BakeOptions& options) {
  ChartSet charts = growCharts(scene);
  TexelLayout layout = layOutTexels(scene, charts, {options.texelsPerMetre, options.texelBudget});
  DirectionSet directions(options.directions);
  TallyLayout tallies = planTallies(scene, charts, layout, directions, options.keepAllDirections);
  return {std::move(charts), std::move(layout), std::move(directions), std::move(tallies)};
}

namespace {

void trace(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options, Tallies& tallies, Baked& baked,
           const std::function<bool(const RunProgress&)>& progress) {
  if (scene.emitters().empty()) return;
  const TexelMap map(scene.scene(), plan.charts, plan.layout, plan.tallies);
  PhotonRunOptions run;
  run.seed = options.seed;
  run.threads = threadCount(options);
  run.part = options.light;
  const auto start = std::chrono::steady_clock::now();
  runPhotons(scene, map, plan.tallies, plan.directions, {0, options.photons}, run, tallies, baked.ledger, progress);
  baked.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Baked bakeScene(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options,
                const std::function<bool(const RunProgress&)>& progress) {
  Baked baked;
  baked.emittedFlux = scene.emitters().totalFlux();
  Tallies tallies(plan.tallies);
  trace(scene, plan, options, tallies, baked, progress);
  baked.contentHash = tallies.contentHash();
  baked.maps = resolve({scene.scene(), plan.charts, plan.layout, plan.tallies, tallies, options.directions, baked.emittedFlux,
                        baked.ledger.photons},
                       options.kernel);
  baked.uv = placeInAtlas(plan.charts, plan.layout, baked.maps);
  return baked;
}

}  // namespace lucarne
