#include "app/check.h"

#include <chrono>

#include "app/bake_environment.h"
#include "app/bake_scene.h"
#include "app/check_features.h"
#include "app/check_layout.h"
#include "app/check_lights.h"
#include "app/check_time.h"
#include "app/load_scene.h"
#include "app/trace_variant.h"
#include "base/memory.h"

namespace lucarne {
namespace {

nlohmann::json settingsOf(const BakeOptions& o) {
  return {{"photons", o.photons},
          {"directions", o.directions},
          {"texels_per_metre", o.texelsPerMetre},
          {"texel_budget", o.texelBudget},
          {"keep_all_directions", o.keepAllDirections},
          {"format", nameOf(o.format.directional)}};
}

nlohmann::json sectionsOf(const CheckInput& in) {
  CheckWarnings warnings;
  nlohmann::json checked = {
      {"kind", "check"}, {"program", std::string("lucarne ") + LUCARNE_VERSION}, {"settings", settingsOf(in.options)}};
  checked["scene"] = checkSize(in, warnings);
  checked["modelled"] = listModelled(in.scene());
  checked["left_out"] = in.scene().leftOut;
  checked["lights"] = checkLights(in, warnings);
  checked["uv"] = checkUv(in.scene());
  checked["layout"] = checkLayout(in, warnings);
  checked["resources"] = checkResources(in, warnings);
  checked["time"] = checkTime(in, checked["layout"], warnings);
  checked["time"]["variant"] = traceVariant(in.scene());
  checked["warnings"] = warnings.list();
  return checked;
}

}  // namespace

nlohmann::json checkScene(const BakeOptions& asked) {
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
  const BakePlan plan = makePlan(packed.scene, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sectionsOf({options, photonScene, plan, packed.glb.size(), seconds, peakMemoryBytes()});
}

}  // namespace lucarne
