#include "app/bake.h"

#include <nlohmann/json.hpp>

#include "app/bake_identity.h"
#include "app/bake_outputs.h"
#include "app/bake_report.h"
#include "app/bake_resume.h"
#include "app/builtin_scene.h"
#include "base/error.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/system.h"
#include "base/units.h"
#include "distributed/bake_job.h"
#include "distributed/build_info.h"
#include "distributed/probe_rays.h"
#include "tracer/scene/gltf_packer.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {
namespace {

PackedScene load(const BakeOptions& options) {
  if (options.scene) return readPacked(*options.scene);
  const auto bytes = builtinScene();
  std::vector<std::uint8_t> glb = packGltf(*loadGltfSource(bytes, "the built-in scene"));
  Scene scene = readGlb(glb, "the built-in scene");
  return {std::move(glb), std::move(scene)};
}

/// Maps take at most half of what the tallies do; they exist together while resolving.
void checkMemory(const BakePlan& plan) {
  const std::uint64_t needed = plan.tallies.bytes() + plan.tallies.bytes() / 2;
  const std::uint64_t available = availableMemoryBytes();
  if (needed <= available) return;
  throw Error(ExitCode::outOfResource, "light maps need " + formatBytes(needed) + " and " + formatBytes(available) +
                                           " are free: lower --density, --texels or --directions");
}

void warnAbout(const PhotonScene& scene, const BakePlan& plan, const BakeOptions& options) {
  for (const std::string& what : scene.scene().leftOut) logWarning("not modelled: " + what);
  for (const std::string& light : scene.emitters().dark()) logWarning("light '" + light + "' gives no light");
  if (scene.emitters().empty()) logWarning(sceneName(options) + " has no light: the light maps will be black");
  if (plan.layout.thinned)
    logWarning("density lowered from " + formatNumber(options.texelsPerMetre) + " to " + formatNumber(plan.layout.texelsPerMetre) +
               " texels/m by the budget of " + formatCount(options.texelBudget) + " texels (--texels); is the scene in metres?");
}

/// Of a bake that has traced nothing yet.
PartHeader headerOf(const BakeOptions& options, const PackedScene& packed, const PhotonScene& scene, const BakePlan& plan) {
  PartHeader header;
  header.sceneName = sceneName(options);
  header.identity = {hashBytes(packed.glb), traceSettings(options), resolveSettings(options), layoutHash(plan),
                     scene.emitters().totalFlux()};
  header.makers = {{buildName(), scene.rayCaster().description(), cpuName(), probeRays(scene)}};
  header.planned = {options.photons, options.part ? options.part->n : 0};
  return header;
}

/// Traces what the state lacks. A scene without light is at once as good as traced.
void trace(const BakeOptions& options, const PackedScene& packed, const PhotonScene& scene, const BakePlan& plan, BakeState& state,
           CheckpointFolder& folder) {
  const IndexRange range = photonsOf(options);
  if (scene.emitters().empty()) {
    state.header.photons = IndexSet(range);
    if (options.checkpointSeconds > 0) folder.save(state.header, packed.glb, state.tallies);
    return;
  }
  const TexelMap map(packed.scene, plan.charts, plan.layout, plan.tallies);
  ProgressLine progress("baking", range.size(), options.quiet);
  const auto show = [&progress](const RunProgress& p) { progress.update(p.photons, p.rays); };
  const BakeJob job{{scene, map, plan.tallies, plan.directions}, runOptions(options), range, packed.glb, options.checkpointSeconds, show};
  runJob(job, state, &folder);
  progress.finish();
}

}  // namespace

nlohmann::json bake(const BakeOptions& options) {
  check(options);
  checkOutputs(options);
  const PackedScene packed = load(options);
  const PhotonScene scene(packed.scene, {options.isa, true});
  const BakePlan plan = makePlan(packed.scene, options);
  checkMemory(plan);
  warnAbout(scene, plan, options);
  BakeState state{headerOf(options, packed, scene, plan), Tallies(plan.tallies)};
  if (std::optional<nlohmann::json> report = finishedBefore(options, state.header)) return writeReport(options, *report);
  CheckpointFolder folder(checkpointPath(options));
  takeUp(options, folder, state);
  trace(options, packed, scene, plan, state, folder);
  return finish(options, packed, plan, state, folder);
}

}  // namespace lucarne
