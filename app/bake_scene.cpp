#include "app/bake_scene.h"

#include <chrono>

#include "base/system.h"
#include "dlm/resolve.h"

namespace lucarne {

int threadCount(const BakeOptions& options) {
  return options.threads > 0 ? options.threads : threadCount();
}

BakePlan makePlan(const Scene& scene, const BakeOptions& options, std::uint64_t texelLimit) {
  ChartSet charts = growCharts(scene);
  TexelLayout layout = layOutTexels(scene, charts, {options.texelsPerMetre, options.texelBudget, texelLimit});
  DirectionSet directions(options.directions);
  TallyLayout tallies = planTallies(scene, charts, layout, directions, options.keepAllDirections);
  return {std::move(charts), std::move(layout), std::move(directions), std::move(tallies)};
}

Baked resolveBake(const Scene& scene, const BakePlan& plan, const BakeOptions& options, double emittedFlux, const Ledger& ledger,
                  const Tallies& tallies) {
  Baked baked;
  baked.ledger = ledger;
  baked.emittedFlux = emittedFlux;
  baked.contentHash = tallies.contentHash();
  baked.maps = resolve({scene, plan.charts, plan.layout, plan.tallies, tallies, options.directions, emittedFlux, ledger.photons}, options.kernel);
  baked.uv = placeInAtlas(plan.charts, plan.layout, baked.maps);
  return baked;
}

PhotonRunOptions runOptions(const BakeOptions& options) {
  PhotonRunOptions run;
  run.seed = options.seed;
  run.threads = threadCount(options);
  run.part = options.light;
  return run;
}

Baked bakeScene(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options,
                const std::function<bool(const RunProgress&)>& progress) {
  Tallies tallies(plan.tallies);
  Ledger ledger;
  const auto start = std::chrono::steady_clock::now();
  if (!scene.emitters().empty()) {
    const TexelMap map(scene.scene(), plan.charts, plan.layout, plan.tallies);
    runPhotons({scene, map, plan.tallies, plan.directions}, {0, options.photons}, runOptions(options), tallies, ledger, progress);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Baked baked = resolveBake(scene.scene(), plan, options, scene.emitters().totalFlux(), ledger, tallies);
  baked.seconds = seconds;
  return baked;
}

}  // namespace lucarne
