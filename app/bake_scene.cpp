#include "app/bake_scene.h"

#include <tbb/global_control.h>

#include <chrono>

#include "app/choose_directions.h"
#include "base/log.h"
#include "base/system.h"
#include "base/units.h"
#include "distributed/direct_run.h"
#include "dlm/resolve.h"
#include "tracer/transport/guide_pilot.h"

namespace lucarne {

int threadCount(const BakeOptions& options) { return options.threads > 0 ? options.threads : threadCount(); }

BakePlan makePlan(const Scene& scene, const BakeOptions& options, std::uint64_t texelLimit) {
  ChartOptions chartOptions;
  chartOptions.useUv1 = options.charts == ChartMode::automatic;
  ChartSet charts = growCharts(scene, chartOptions);
  TexelLayout layout = layOutTexels(scene, charts, {options.texelsPerMetre, options.texelBudget, texelLimit});
  DirectionSet directions(options.directions, options.directionFilter);
  TallyLayout tallies = planTallies(scene, charts, layout, directions, tallyWishes(options));
  return {std::move(charts), std::move(layout), std::move(directions), std::move(tallies)};
}

Baked resolveBake(const Scene& scene, const BakePlan& plan, const BakeOptions& options, const PartHeader& header,
                  const Tallies& tallies, SharedContacts contacts) {
  Baked baked;
  baked.ledger = header.ledger;
  if (header.direct) baked.direct = *header.direct;
  baked.emittedFlux = header.identity.emittedFlux;
  baked.contentHash = tallies.contentHash();
  if (contacts == nullptr)
    contacts = findContacts(scene, plan, options, RayCaster(scene, RayCasterOptions{options.isa, true}));
  baked.contacts = std::move(contacts);
  baked.maps = resolve({scene, plan.charts, plan.layout, plan.tallies, tallies, options.directions, baked.emittedFlux,
                        header.ledger.photons, baked.direct.samples.count(), baked.direct.samples.countOdd(),
                        *baked.contacts},
                       options.kernel, &baked.kernelBias);
  baked.maps.directionFilter = options.directionFilter;
  const SeamSet seams = findSeams(scene, plan.charts, plan.layout, baked.maps, *baked.contacts);
  baked.seams = fitSeams(seams, plan.layout, baked.maps, options.seams == SeamMode::fit);
  baked.dropped = dropFaintMaps(baked.maps, options.dropError);
  baked.uv = placeInAtlas(plan.charts, plan.layout, baked.maps);
  return baked;
}

void settleDirections(const Scene& scene, BakeOptions& options) {
  if (!options.chooseDirections) return;
  const DirectionChoice choice = chooseDirections(scene);
  options.directions = choice.directions;
  options.chooseDirections = false;
  if (choice.glossy > 0)
    logInfo(std::to_string(choice.directions) + " directions: " + formatPercent(choice.shown) +
            " of what is glossy will look as sharp as it is (--directions)");
}

void prepareEmission(PhotonScene& scene, BakeOptions& options) {
  const Environment* sky = scene.emitters().environment();
  options.environmentHash = sky != nullptr ? sky->contentHash().hex() : std::string();
  options.guideHash.clear();
  if (!options.guidedEmission || scene.emitters().empty()) return;
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threadCount(options)));
  for (const GuidePilotResult& pilot : learnGuides(scene, {.seed = options.seed})) {
    if (pilot.wasted > 0.5 || pilot.guided)
      logInfo(formatPercent(pilot.wasted) + " of the photons of " + scene.emitters().nameOf(pilot.emitter) +
              " would light nothing" +
              (pilot.guided ? ": guided, which makes them worth " + formatNumber(pilot.gain) + " times as many" : ""));
  }
  if (scene.emitters().guides().empty()) return;
  Hasher hasher;
  for (const EmissionGuide& guide : scene.emitters().guides()) hasher.addText(guide.hash().hex());
  options.guideHash = hasher.finish().hex();
}

PhotonRunOptions runOptions(const BakeOptions& options) {
  PhotonRunOptions run;
  run.seed = {options.seed, options.sampler};
  run.threads = threadCount(options);
  if (!options.ownTallies) run.privateTallyBytes = 0;
  run.part = gathersDirect(options) ? LightPart::indirect : options.light;
  return run;
}

Baked bakeScene(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options,
                const std::function<bool(const RunProgress&)>& progress) {
  Tallies tallies(plan.tallies, tallySets(options));
  PartHeader header;
  header.identity.emittedFlux = scene.emitters().totalFlux();
  const auto start = std::chrono::steady_clock::now();
  if (gathersDirect(options) && !scene.emitters().empty()) {
    const DirectGather gather({scene, plan.charts, plan.layout, plan.tallies, plan.directions},
                              {options.seed, options.sampler});
    DirectRun run(gather, threadCount(options), tallies);
    header.direct = DirectPart{IndexSet(samplesOf(options)), {}, 0};
    run.gather(samplesOf(options), [] { return true; });
    run.collect(header.direct->counts);
  }
  if (tracesPhotons(options) && !scene.emitters().empty()) {
    const TexelMap map(scene.scene(), plan.charts, plan.layout, plan.tallies);
    runPhotons({scene, map, plan.tallies, plan.directions}, {0, options.photons}, runOptions(options), tallies,
               header.ledger, progress);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Baked baked = resolveBake(scene.scene(), plan, options, header, tallies);
  baked.seconds = seconds;
  return baked;
}

}  // namespace lucarne
