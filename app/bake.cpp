#include "app/bake.h"

#include <nlohmann/json.hpp>

#include "app/bake_report.h"
#include "app/builtin_scene.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/units.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {
namespace {

Scene load(const BakeOptions& options) {
  return options.scene ? readGltf(*options.scene) : readGlb(builtinScene(), "the built-in scene");
}

/// Asked before the work, not after it.
void checkOutputs(const BakeOptions& options) {
  checkWritable(options.output);
  if (std::filesystem::exists(options.output) && !holdsLightMaps(options.output))
    throw Error(ExitCode::failed, "will not replace " + options.output.string() + ": it is not a folder of light maps; remove it or name another");
  if (options.report) checkWritable(*options.report);
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

}  // namespace

nlohmann::json bake(const BakeOptions& options) {
  check(options);
  checkOutputs(options);
  const Scene scene = load(options);
  const PhotonScene photonScene(scene, {options.isa, true});
  const BakePlan plan = makePlan(scene, options);
  checkMemory(plan);
  warnAbout(photonScene, plan, options);
  ProgressLine progress("baking", options.photons, options.quiet);
  const Baked baked = bakeScene(photonScene, plan, options, [&](const RunProgress& p) {
    progress.update(p.photons, p.rays);
    return true;
  });
  progress.finish();
  nlohmann::json report = makeReport(options, photonScene, plan, baked);
  writeDlm(options.output, scene, baked.uv, baked.maps, provenanceOf(report), options.format);
  report["peak_memory_bytes"] = peakMemoryBytes();
  if (options.report) writeFileAtomically(*options.report, dumpJson(report));
  return report;
}

}  // namespace lucarne
