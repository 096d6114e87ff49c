#include "app/bake.h"

#include <nlohmann/json.hpp>

#include "app/bake_environment.h"
#include "app/bake_identity.h"
#include "app/bake_outputs.h"
#include "app/bake_ranks.h"
#include "app/bake_report.h"
#include "app/bake_resume.h"
#include "app/load_scene.h"
#include "app/trace_variant.h"
#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/system.h"
#include "base/units.h"
#include "distributed/bake_job.h"
#include "distributed/build_info.h"
#include "distributed/mpi_job.h"
#include "distributed/probe_rays.h"

namespace lucarne {
namespace {

/// Tallies and maps exist together while resolving, in one process. `processes` of them share the machine's memory.
void checkMemory(const BakePlan& plan, const BakeOptions& options, int processes) {
  const std::uint64_t needed =
      tallyBytes(plan, options) * static_cast<std::uint64_t>(processes) + memoryOfMaps(plan.tallies.bytes());
  const std::uint64_t available = availableMemoryBytes();
  if (needed <= available) return;
  throw Error(ExitCode::outOfResource, "light maps need " + formatBytes(needed) + " and " + formatBytes(available) +
                                           " are free: lower --density, --texels or --directions" +
                                           (processes > 1 ? ", or start fewer ranks with more --threads" : ""));
}

void warnAbout(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options) {
  for (const std::string& what : scene.scene().leftOut) logWarning("not modelled: " + what);
  for (const std::string& light : scene.emitters().dark()) logWarning("light '" + light + "' gives no light");
  if (options.isa.empty() && scene.rayCaster().isa() != "avx2")
    logWarning("this processor has no avx2: rays are traced with " + scene.rayCaster().isa() +
               ", and may differ in rounding from those of other machines");
  if (scene.emitters().empty()) logWarning(sceneName(options) + " has no light: the light maps will be black");
  for (const std::string& why : plan.charts.uv1Refused) logWarning(why + ": charts are grown instead");
  if (plan.layout.thinned)
    logWarning("density lowered from " + formatNumber(options.texelsPerMetre) + " to " +
               formatNumber(plan.layout.texelsPerMetre) + " texels/m by the budget of " +
               formatCount(options.texelBudget) + " texels (--texels); is the scene in metres?");
}

/// Of a bake that has traced nothing yet.
PartHeader headerOf(const BakeOptions& options, const PackedScene& packed, const PhotonScene& scene,
                    const BakePlan& plan) {
  PartHeader header;
  header.sceneName = sceneName(options);
  header.environmentName = environmentName(options);
  header.identity = {hashBytes(packed.glb), traceSettings(options), resolveSettings(options), layoutHash(plan),
                     scene.emitters().totalFlux()};
  header.makers = {{buildName(), scene.rayCaster().description(), cpuName(), probeRays(scene)}};
  header.planned = {options.photons, options.part ? options.part->n : 0, 0};
  if (gathersDirect(options)) {
    header.planned.samples = options.directSamples;
    header.direct.emplace();
  }
  return header;
}

/// Gathers and traces what the state lacks. A scene without light is at once as good as traced, and so are photons that
/// would store nothing.
void trace(MpiJob* mpi, const BakeOptions& options, const PackedScene& packed, const PhotonScene& scene,
           const BakePlan& plan, BakeState& state, CheckpointFolder& folder) {
  const IndexRange range = photonsOf(options);
  const bool root = mpi == nullptr || mpi->rank() == 0;
  if (scene.emitters().empty()) {
    state.header.photons = IndexSet(range);
    if (state.header.direct) state.header.direct->samples = IndexSet(samplesOf(options));
    if (root && options.checkpointSeconds > 0) folder.save(state.header, packed.glb, state.tallies);
    return;
  }
  if (root) state.variantSpeedup = traceVariantSpeedup(scene);
  const TexelMap map(packed.scene, plan.charts, plan.layout, plan.tallies);
  if (!tracesPhotons(options)) state.header.photons = IndexSet(range);
  std::optional<DirectGather> gather;
  if (gathersDirect(options)) {
    gather.emplace(GatherScene{scene, plan.charts, plan.layout, plan.tallies, plan.directions},
                   PhotonSeed{options.seed, options.sampler});
    if (root) logInfo("gathering direct light: samples " + toText(IndexSet(samplesOf(options))) + " of every texel");
  }
  ProgressLine progress("baking", range.size(), options.quiet || !root);
  progress.startFrom(state.header.photons.count(), state.header.ledger.rays);
  const auto show = [&progress](const RunProgress& p) { progress.update(p.photons, p.rays); };
  const BakeJob job{{scene, map, plan.tallies, plan.directions},
                    runOptions(options),
                    range,
                    packed.glb,
                    options.checkpointSeconds,
                    writesPart(options) || options.keepPart,
                    show,
                    gather ? std::optional(DirectJob{*gather, samplesOf(options)}) : std::nullopt};
  if (mpi != nullptr) {
    mpi->run(job, state, &folder);
  } else {
    runJob(job, state, &folder);
  }
  progress.finish();
}

/// The bake of one process, or of all ranks together: rank 0 alone reads, saves, writes and tells. Steps that can fail
/// on one rank while the others wait are agreed on. Returns the report on rank 0.
nlohmann::json bakeWith(MpiJob* mpi, BakeOptions options) {
  const bool root = mpi == nullptr || mpi->rank() == 0;
  const auto agree = [mpi](const std::function<void()>& f) { mpi == nullptr ? f() : mpi->agree(f); };
  PackedScene packed;
  ImageRgb sky;
  agree([&] {
    check(options);
    if (!root) return;
    checkOutputs(options);
    packed = loadScene(options);
    sky = loadSky(options);
  });
  if (mpi != nullptr) {
    shareScene(*mpi, packed);
    shareSky(*mpi, sky);
    options.threads = threadsOfRank(*mpi, options);
    options.ranks = mpi->size();
  }
  std::unique_ptr<Environment> environment;
  std::optional<PhotonScene> scene;
  std::optional<BakePlan> plan;
  std::optional<BakeState> state;
  agree([&] {
    environment = makeEnvironment(std::move(sky), options);
    scene.emplace(packed.scene, RayCasterOptions{options.isa, true}, environment.get());
    settleDirections(packed.scene, options);
    prepareEmission(*scene, options);
    plan.emplace(makePlan(packed.scene, options));
    checkMemory(*plan, options, mpi == nullptr ? 1 : mpi->localSize());
    if (root) warnAbout(*scene, *plan, options);
    state.emplace(BakeState{headerOf(options, packed, *scene, *plan), Tallies(plan->tallies, tallySets(options))});
  });
  if (mpi != nullptr) joinMakers(*mpi, state->header);
  CheckpointFolder folder(checkpointPath(options));
  std::optional<nlohmann::json> finished;
  agree([&] {
    if (!root) return;
    finished = finishedBefore(options, state->header);
    if (!finished) takeUp(options, folder, *state);
  });
  if (mpi != nullptr && mpi->gather(finished ? "finished" : "")[0] == "finished")
    return root ? writeReport(options, *finished) : nullptr;
  if (finished) return writeReport(options, *finished);
  trace(mpi, options, packed, *scene, *plan, *state, folder);
  return root ? finish(options, packed, *plan, *state, folder) : nullptr;
}

}  // namespace

nlohmann::json bake(const BakeOptions& options) {
  const std::unique_ptr<MpiJob> mpi = MpiJob::join();
  if (mpi == nullptr) return bakeWith(nullptr, options);
  if (mpi->rank() != 0) setQuiet(true);
  ExitCode code = ExitCode::failed;
  std::string message;
  try {
    return bakeWith(mpi.get(), options);
  } catch (const AgreedError&) {
    if (mpi->rank() == 0) throw;
    return nullptr;
  } catch (const Error& error) {
    code = error.code();
    message = error.what();
  } catch (const std::bad_alloc&) {
    code = ExitCode::outOfResource;
    message = "out of memory";
  } catch (const std::exception& error) {
    message = std::string("internal error: ") + error.what();
  }
  mpi->fail(code, message);
  return nullptr;
}

}  // namespace lucarne
