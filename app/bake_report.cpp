#include "app/bake_report.h"

#include "app/ledger_json.h"
#include "base/units.h"
#include "dlm/resolve.h"

namespace lucarne {
namespace {

/// How much of Ω the materials let us leave out, in words, and what that saved.
nlohmann::json leftOut(const Scene& scene, const BakePlan& plan, int directions) {
  nlohmann::json list = scene.leftOut;
  std::uint64_t saved = 0, sides = 0;
  for (const TallySide& side : plan.tallies.sides) {
    if (!plan.tallies.membersOf(side).members.empty()) continue;
    ++sides;
    // About half of Ω and the cells cut by the horizon would belong to the side.
    saved += side.texelCount() * static_cast<std::uint64_t>(directions / 2) * kLightChannels * 8;
  }
  if (saved > 0)
    list.push_back("directions of " + std::to_string(sides) + " chart sides without a glossy lobe: one irradiance map each, about " +
                   formatBytes(saved) + " of tallies saved");
  return list;
}

nlohmann::json settingsToJson(const BakeOptions& o, const BakePlan& plan) {
  constexpr const char* kShapes[] = {"pyramid", "box", "epanechnikov"};
  constexpr const char* kParts[] = {"all", "direct", "indirect"};
  return {{"photons", o.photons},
          {"directions", o.directions},
          {"texels_per_metre", o.texelsPerMetre},
          {"texels_per_metre_used", plan.layout.texelsPerMetre},
          {"texel_budget", o.texelBudget},
          {"keep_all_directions", o.keepAllDirections},
          {"kernel", kShapes[static_cast<int>(o.kernel.shape)]},
          {"kernel_width", o.kernel.width},
          {"direction_filter", "nearest"},
          {"seed", o.seed},
          {"light", kParts[static_cast<int>(o.light)]},
          {"fixed_point_bits", kFixedPointBits}};
}

std::uint64_t storedMapBytes(const LightMaps& maps) {
  return maps.directional.size() * sizeof(Rgb) + maps.irradiance.size() * (sizeof(Rgb) + 2 * sizeof(float));
}

double perSecond(std::uint64_t count, double seconds) { return seconds > 0 ? static_cast<double>(count) / seconds : 0; }

}  // namespace

std::string sceneName(const BakeOptions& options) { return options.scene ? options.scene->filename().string() : "glossy_room.glb (built in)"; }

nlohmann::json makeReport(const BakeOptions& options, const PhotonScene& scene, const BakePlan& plan, const Baked& baked) {
  const Ledger& ledger = baked.ledger;
  nlohmann::json report = ledgerToJson(ledger, baked.emittedFlux);
  report["program"] = std::string("lucarne ") + LUCARNE_VERSION;
  report["scene"] = sceneName(options);
  report["settings"] = settingsToJson(options, plan);
  report["photons"] = ledger.photons;
  report["seconds"] = baked.seconds;
  report["photons_per_second"] = perSecond(ledger.photons, baked.seconds);
  report["rays"] = ledger.rays;
  report["rays_per_second"] = perSecond(ledger.rays, baked.seconds);
  report["stored_hits"] = ledger.storedHits;
  report["charts"] = plan.charts.charts.size();
  report["directions"] = options.directions;
  report["texels"] = plan.tallies.texels;
  report["tally_bytes"] = plan.tallies.bytes();
  report["map_bytes"] = storedMapBytes(baked.maps);
  report["estimated_relative_error"] = estimatedRelativeError(baked.maps, plan.layout);
  report["content_hash"] = baked.contentHash.hex();
  report["left_out"] = leftOut(scene.scene(), plan, options.directions);
  report["ray_caster"] = scene.rayCaster().description();
  report["threads"] = threadCount(options);
  return report;
}

nlohmann::json provenanceOf(nlohmann::json report) {
  for (const char* key : {"seconds", "photons_per_second", "rays_per_second", "threads", "peak_memory_bytes"}) report.erase(key);
  return report;
}

}  // namespace lucarne
