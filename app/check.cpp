#include "app/check.h"

#include <chrono>

#include "app/bake_environment.h"
#include "app/bake_identity.h"
#include "app/bake_report.h"
#include "app/bake_scene.h"
#include "app/check_features.h"
#include "app/check_layout.h"
#include "app/check_lights.h"
#include "app/check_surfaces.h"
#include "app/check_time.h"
#include "app/load_scene.h"
#include "app/plan_file.h"
#include "app/trace_variant.h"
#include "base/error.h"

namespace lucarne {
namespace {

nlohmann::json settingsOf(const BakeOptions& o) {
  return {{"photons", o.photons},
          {"directions", o.directions},
          {"texels_per_metre", o.texelsPerMetre},
          {"texel_budget", o.texelBudget},
          {"keep_all_directions", o.keepAllDirections},
          {"direction_filter", nameOf(o.directionFilter)},
          {"format", nameOf(o.format.directional)}};
}

nlohmann::json sectionsOf(const CheckInput& in) {
  CheckWarnings warnings, failures;
  nlohmann::json checked = {
      {"kind", "check"}, {"program", std::string("lucarne ") + LUCARNE_VERSION}, {"settings", settingsOf(in.options)}};
  checked["scene"] = checkSize(in, warnings);
  checked["modelled"] = listModelled(in.scene());
  checked["left_out"] = in.scene().leftOut;
  checked["lights"] = checkLights(in, warnings);
  checked["uv"] = checkUv(in.scene());
  checked["surfaces"] = checkSurfaces(in.scene());
  checked["layout"] = checkLayout(in, warnings);
  checked["resources"] = checkResources(in, warnings, failures);
  checked["time"] = checkTime(in, checked["layout"], warnings, failures);
  checked["time"]["variant"] = traceVariant(in.scene());
  checked["warnings"] = warnings.list();
  checked["failures"] = nlohmann::json::array();
  for (const nlohmann::json& failure : failures.list()) checked["failures"].push_back(failure["text"]);
  return checked;
}

/// A layout that no budget allows ends a bake with "out of resources"; here it is what was asked.
BakePlan planForCheck(const Scene& scene, const BakeOptions& options) {
  try {
    return makePlan(scene, options);
  } catch (const Error& error) {
    throw InputError(std::string("the bake would fail: ") + error.what());
  }
}

PartHeader headerOf(const BakeOptions& options, const PackedScene& packed, const PhotonScene& scene,
                    const BakePlan& plan) {
  PartHeader header;
  header.sceneName = sceneName(options);
  header.environmentName = environmentName(options);
  header.identity = identityOf(options, scene, plan);
  header.sceneFile = hashBytes(packed.glb);
  header.makers = {makerOf(scene)};
  return header;
}

}  // namespace

nlohmann::json checkScene(const BakeOptions& asked, const std::filesystem::path& planFolder) {
  checkSettings(asked);
  checkMachine(asked);
  BakeOptions options = asked;
  const auto start = std::chrono::steady_clock::now();
  const PackedScene packed = loadScene(options);
  const std::unique_ptr<Environment> sky = makeEnvironment(loadSky(options), options);
  PhotonScene photonScene(packed.scene, RayCasterOptions{options.isa, true}, sky.get());
  settleDirections(packed.scene, options);
  BakeOptions guided = options;
  prepareEmission(photonScene, guided);
  const BakePlan plan = planForCheck(packed.scene, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  nlohmann::json checked = sectionsOf({options, photonScene, plan, packed.glb.size(), seconds, MemorySoFar::now()});
  checked["plan"] = planOf(guided, headerOf(guided, packed, photonScene, plan), planFolder);
  return checked;
}

}  // namespace lucarne
