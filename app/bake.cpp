#include "app/bake.h"

#include <chrono>
#include <nlohmann/json.hpp>

#include "app/bake_environment.h"
#include "app/bake_identity.h"
#include "app/bake_needs.h"
#include "app/bake_outputs.h"
#include "app/bake_ranks.h"
#include "app/bake_report.h"
#include "app/bake_rescue.h"
#include "app/bake_resume.h"
#include "app/bake_trace.h"
#include "app/load_scene.h"
#include "app/plan_file.h"
#include "app/report_writing.h"
#include "base/error.h"
#include "base/log.h"
#include "base/system.h"
#include "base/units.h"
#include "distributed/bake_job.h"
#include "distributed/mpi_job.h"

namespace lucarne {
namespace {

/// Predicted, told, and refused where it is too much. `processes` share the machine's memory.
void checkMemory(const Scene& scene, const BakePlan& plan, BakeOptions& options, int processes, bool tell) {
  const std::uint64_t allowed = allowedMemory(options, processes);
  const MemoryNeeds needs = requireMemory(options, scene, plan, MemorySoFar::now(), allowed);
  if (!tell) return;
  const bool given = options.memoryBytes && allowed == *options.memoryBytes;
  logInfo("memory: " + formatBytes(needs.peak()) + " expected at the most, of " + formatBytes(allowed) +
          (given ? " allowed" : " free"));
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
  header.sceneFile = hashBytes(packed.glb);
  header.identity = identityOf(options, scene, plan);
  header.makers = {makerOf(scene)};
  header.planned = {options.photons == kUnlimitedPhotons ? 0 : options.photons, options.part ? options.part->n : 0, 0};
  if (gathersDirect(options)) {
    header.planned.samples = options.directSamples;
    header.direct.emplace();
  }
  return header;
}

/// Of a bake that was told to stop. All ranks know, and rank 0 tells it.
[[noreturn]] void throwInterrupted(const BakeSetup& setup, const BakeState& state, const JobResult& result,
                                   CheckpointFolder& folder) {
  std::string line = "interrupted: ";
  if (result.saved) {
    line += howToGoOn(state, folder.path().string());
  } else if (setup.options.checkpointSeconds == 0) {
    line += "nothing is saved, since --checkpoint is 0";
  } else {
    line += rescueState(setup, state, folder);
  }
  throw AgreedError(ExitCode::interrupted, line);
}

/// The bake of one process, or of all ranks together: rank 0 alone reads, saves, writes and tells. Steps that can fail
/// on one rank while the others wait are agreed on. Returns the report on rank 0.
nlohmann::json bakeWith(MpiJob* mpi, BakeOptions options, const JobControl& control,
                        const PlayerPictures& player) {
  const auto start = std::chrono::steady_clock::now();
  control.mayEndAtOnce("interrupted before the first photon; nothing is lost");
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
    checkMemory(packed.scene, *plan, options, mpi == nullptr ? 1 : mpi->localSize(), root);
    if (root) warnAbout(*scene, *plan, options);
    state.emplace(BakeState{headerOf(options, packed, *scene, *plan), Tallies(plan->tallies, tallySets(options))});
  });
  if (mpi != nullptr) joinMakers(*mpi, state->header);
  if (options.plan) {
    agree([&] {
      if (root) checkAgainstPlan(*options.plan, state->header);
    });
  }
  CheckpointFolder folder(checkpointPath(options));
  std::optional<nlohmann::json> finished;
  agree([&] {
    if (!root) return;
    finished = finishedBefore(options, state->header);
    if (finished) return;
    requireDisk(options, predictDisk(options, packed.scene, *plan, packed.glb.size()), options.resume ? folder.bytes() : 0);
    takeUp(options, packed.scene, folder, *state);
  });
  const ReportContext context{options, *scene, *plan, player};
  if (mpi != nullptr && mpi->gather(finished ? "finished" : "")[0] == "finished")
    return root ? writeReport(context, state->header, nullptr, *finished) : nullptr;
  if (finished) return writeReport(context, state->header, nullptr, *finished);
  control.mayEndAtOnce("");
  BakeContacts contacts(packed.scene, *plan, options, scene->rayCaster());
  const BakeSetup setup{mpi, options, packed, *scene, *plan, control, player, contacts, start};
  const JobResult result = traceBake(setup, *state, folder);
  if (!root) return nullptr;
  if (result.end == JobEnd::interrupted) throwInterrupted(setup, *state, result, folder);
  return finish(setup, *state, folder, result);
}

}  // namespace

nlohmann::json bake(const BakeOptions& options, const JobControl& control, const PlayerPictures& player) {
  const std::unique_ptr<MpiJob> mpi = MpiJob::join();
  if (mpi == nullptr) return bakeWith(nullptr, options, control, player);
  if (mpi->rank() != 0) setQuiet(true);
  ExitCode code = ExitCode::failed;
  std::string message;
  try {
    return bakeWith(mpi.get(), options, control, player);
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
