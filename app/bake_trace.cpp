#include "app/bake_trace.h"

#include <tbb/task_arena.h>

#include "app/bake_outputs.h"
#include "app/bake_scene.h"
#include "app/rate_recorder.h"
#include "app/trace_variant.h"
#include "base/error.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/units.h"

namespace lucarne {
namespace {

StopRules rulesOf(const BakeSetup& setup, const BakeState& state) {
  StopRules rules;
  rules.targetError = setup.options.targetError;
  if (!setup.options.timeLimit) return rules;
  const std::uint64_t gathered = state.header.direct ? state.header.direct->microseconds : 0;
  const double earlier = static_cast<double>(state.header.microseconds + gathered) * 1e-6;
  const std::chrono::duration<double> left(*setup.options.timeLimit - earlier);
  rules.deadline = setup.start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(left);
  return rules;
}

ProgressGoal goalOf(const BakeOptions& options, const StopRules& rules) {
  ProgressGoal goal;
  if (options.photons != kUnlimitedPhotons) goal.photons = photonsOf(options).size();
  goal.targetError = options.targetError;
  goal.nextJudged = [rules](std::uint64_t photons) { return rules.nextJudged(photons); };
  if (!options.timeLimit) return goal;
  const std::chrono::duration<double> left = rules.deadline - std::chrono::steady_clock::now();
  goal.seconds = std::max(0.0, left.count());
  return goal;
}

/// Photons are traced when all direct light is gathered.
void tell(ProgressLine& progress, const BakeOptions& options, const JobProgress& p) {
  const std::uint64_t samples = samplesOf(options).size();
  if (p.samples < samples) {
    progress.updateGathering(p.samples, samples);
  } else {
    progress.update(p.photons, p.rays, p.untilCheckpoint);
  }
}

/// Light maps of what there is. Whatever goes wrong is no reason to end the bake.
void writePreview(const BakeSetup& setup, const BakeState& state) {
  try {
    const auto path = previewPath(setup.options);
    const nlohmann::json report = writeMaps(setup, state, path);
    logInfo("wrote " + path.string() + ": " + formatCount(state.header.photons.count()) + " photons, estimated error " +
            formatPercent(report["estimated_relative_error"].get<double>()) + "; the bake goes on");
  } catch (const Error& error) {
    logWarning(std::string("no preview: ") + error.what() + "; the bake goes on");
  }
}

double estimateError(const BakeSetup& setup, const BakeState& state) {
  const BakePlan& plan = setup.plan;
  const PartHeader& header = state.header;
  const IndexSet samples = header.direct ? header.direct->samples : IndexSet();
  const SharedContacts contacts = setup.contacts.get();
  return tbb::task_arena(threadCount(setup.options)).execute([&] {
    return estimateRelativeError(
        {setup.packed.scene, plan.charts, plan.layout, plan.tallies, state.tallies, setup.options.directions,
         header.identity.emittedFlux, header.ledger.photons, samples.count(), samples.countOdd(), *contacts},
        setup.options.kernel);
  });
}

/// Of a scene without light.
JobResult darkBake(const BakeSetup& setup, BakeState& state, CheckpointFolder& folder) {
  const BakeOptions& options = setup.options;
  // What no rule can end without light ends like the default.
  const IndexRange range =
      options.photons == kUnlimitedPhotons ? IndexRange{0, BakeOptions{}.photons} : photonsOf(options);
  state.header.photons = IndexSet(range);
  if (state.header.direct) state.header.direct->samples = IndexSet(samplesOf(options));
  const bool saves = setup.root() && options.checkpointSeconds > 0;
  if (saves) folder.save(state.header, setup.packed.glb, state.tallies);
  return {JobEnd::photons, saves};
}

}  // namespace

JobResult traceBake(const BakeSetup& setup, BakeState& state, CheckpointFolder& folder) {
  const BakeOptions& options = setup.options;
  const PackedScene& packed = setup.packed;
  const BakePlan& plan = setup.plan;
  const PhotonScene& scene = setup.scene;
  MpiJob* const mpi = setup.mpi;
  if (scene.emitters().empty()) return darkBake(setup, state, folder);
  if (setup.root()) state.variantSpeedup = traceVariantSpeedup(scene);
  const TexelMap map(packed.scene, plan.charts, plan.layout, plan.tallies);
  const IndexRange range = photonsOf(options);
  if (!tracesPhotons(options)) state.header.photons = IndexSet(range);
  std::optional<DirectGather> gather;
  if (gathersDirect(options)) {
    gather.emplace(GatherScene{scene, plan.charts, plan.layout, plan.tallies, plan.directions},
                   PhotonSeed{options.seed, options.sampler});
    if (setup.root())
      logInfo("gathering direct light: samples " + toText(IndexSet(samplesOf(options))) + " of every texel");
  }
  const bool json = options.progress == ProgressStyle::json,
             traced = state.header.photons.contains(range),  // a finished part was there: no progress to show
             silent = (options.quiet && !json) || !setup.root() || traced;
  const StopRules rules = rulesOf(setup, state);
  ProgressLine progress("baking", goalOf(options, rules), silent, standardProgressOutput(json));
  progress.startFrom(state.header.photons.count(), state.header.ledger.rays);
  RateRecorder rates(state.header);
  BakeJob job{
      .task = {scene, map, plan.tallies, plan.directions},
      .run = runOptions(options),
      .range = range,
      .scene = packed.glb,
      .checkpointSeconds = options.checkpointSeconds,
      .progress =
          [&](const JobProgress& p) {
            tell(progress, options, p);
            rates.add(p.photons);
          },
      .direct = gather ? std::optional(DirectJob{*gather, samplesOf(options)}) : std::nullopt,
      .rules = rules,
      .control = setup.control,
      .preview = [&setup](BakeState& s) { writePreview(setup, s); },
      .estimateError = {},
      .estimated =
          [&progress](const EstimatedError& e) {
            progress.paused(e.seconds);
            progress.estimated(e.error, e.photons);
          },
  };
  if (options.targetError > 0 || !silent) job.estimateError = [&setup](const BakeState& s) { return estimateError(setup, s); };
  const JobResult result = mpi != nullptr ? mpi->run(job, state, &folder) : runJob(job, state, &folder);
  progress.finish();
  return result;
}

}  // namespace lucarne
