#include "app/bake_report.h"

#include "app/bake_identity.h"
#include "app/ledger_json.h"
#include "app/trace_variant.h"
#include "app/widened_highlights.h"
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

/// Maps of faint directions that the user gave up.
std::string droppedText(const DroppedMaps& d, double bound) {
  return std::to_string(d.maps) + " maps of faint directions, " +
         formatPercent(static_cast<double>(d.texels) / static_cast<double>(d.storedTexels)) + " of their texels: no texel loses more than " +
         formatPercent(d.lost) + "; colour of maps next to neutral, " +
         formatPercent(static_cast<double>(d.neutralTexels) / static_cast<double>(d.storedTexels)) +
         " of the texels (--drop-error " + formatPercent(bound) + ")";
}

nlohmann::json settingsToJson(const BakeOptions& o, const BakePlan& plan) {
  nlohmann::json settings = traceSettings(o);
  settings.update(resolveSettings(o));
  settings.update(stopSettings(o));
  if (gathersDirect(o)) settings["direct_samples"] = o.directSamples;
  settings["texels_per_metre_used"] = plan.layout.texelsPerMetre;
  settings["seams"] = seamsName(o);
  settings.update(formatSettings(o.format));
  return settings;
}

/// Of all makers, each kind once, so that the order of merging does not show.
std::string rayCasters(const std::set<Maker>& makers) {
  std::set<std::string> kinds;
  for (const Maker& m : makers) kinds.insert(m.rayCaster);
  std::string text;
  for (const std::string& kind : kinds) text += (text.empty() ? "" : "; ") + kind;
  return text;
}

std::uint64_t storedMapBytes(const LightMaps& maps) {
  return maps.directional.size() * sizeof(Rgb) + maps.meanDirections.size() * sizeof(Vec3f) + maps.irradiance.size() * (sizeof(Rgb) + 2 * sizeof(float));
}

nlohmann::json seamsToJson(const SeamReport& r, const BakeOptions& o) {
  return {{"mode", seamsName(o)},          {"count", r.seams},
          {"length_m", r.length},          {"rms_jump_before", r.jumpBefore},
          {"rms_jump", r.jumpAfter},       {"largest_jump_before", r.worstBefore},
          {"largest_jump", r.worstAfter},  {"flux_change", r.fluxChange}};
}

double perSecond(std::uint64_t count, double seconds) { return seconds > 0 ? static_cast<double>(count) / seconds : 0; }

}  // namespace

nlohmann::json stopSettings(const BakeOptions& o) {
  nlohmann::json settings = {{"photons", o.photons == kUnlimitedPhotons ? nlohmann::json() : nlohmann::json(o.photons)}};
  if (o.timeLimit) settings["time_seconds"] = *o.timeLimit;
  if (o.targetError > 0) settings["target_error"] = o.targetError;
  return settings;
}

nlohmann::json formatSettings(const DlmFormat& format) {
  nlohmann::json settings = {{"format", nameOf(format.directional)}};
  if (format.directional == MapFormat::ldr8) settings["k_max"] = format.kMax;
  return settings;
}

std::string sceneName(const BakeOptions& options) { return options.scene ? options.scene->filename().string() : kBuiltinSceneName; }

nlohmann::json makeReport(const ReportInput& in) {
  const Ledger& ledger = in.header.ledger;
  const double seconds = static_cast<double>(in.header.microseconds) * 1e-6;
  nlohmann::json report = ledgerToJson(ledger, in.header.identity.emittedFlux);
  report["direct"] = directToJson(in.header);
  report["program"] = std::string("lucarne ") + LUCARNE_VERSION;
  report["scene"] = in.header.sceneName;
  report["scene_hash"] = in.header.identity.scene.hex();
  report["scene_file_hash"] = in.header.sceneFile.hex();
  report["settings"] = settingsToJson(in.options, in.plan);
  report["settings_hash"] = in.header.identity.settingsHash().hex();
  report["photons"] = ledger.photons;
  report["photon_ranges"] = toJson(in.header.photons);
  report["seconds"] = seconds;
  report["photons_per_second"] = perSecond(ledger.photons, seconds);
  report["rays"] = ledger.rays;
  report["rays_per_second"] = perSecond(ledger.rays, seconds);
  report["stored_hits"] = ledger.storedHits;
  report["charts"] = in.plan.charts.charts.size();
  report["uv1_charts"] = in.plan.charts.uv1Charts;
  report["uv1_refused"] = in.plan.charts.uv1Refused;
  report["directions"] = in.options.directions;
  report["texels"] = in.plan.tallies.texels;
  report["tally_bytes"] = tallyBytes(in.plan, in.options);
  report["content_hash"] = in.header.content.hex();
  report["left_out"] = leftOut(in.scene, in.plan, in.options.directions);
  report["ray_caster"] = rayCasters(in.header.makers);
  report["trace_variant"] = traceVariant(in.scene);
  report["threads"] = threadCount(in.options);
  report["ranks"] = in.options.ranks;
  if (in.baked == nullptr) return report;
  if (in.baked->dropped.maps + in.baked->dropped.neutralTexels > 0) report["left_out"].push_back(droppedText(in.baked->dropped, in.options.dropError));
  report["seams"] = seamsToJson(in.baked->seams, in.options);
  report["map_bytes"] = storedMapBytes(in.baked->maps);
  if (in.options.format.directional == MapFormat::ldr8)
    report["cut_flux"] = ldrScales(in.baked->maps, in.options.format.kMax).cutFlux;
  if (in.options.kernel.shape == KernelShape::adaptive) report["kernel_bias"] = in.baked->kernelBias.relative();
  report["estimated_relative_error"] = estimatedRelativeError(in.baked->maps, in.plan.layout);
  report["widened_highlights"] = widenedHighlightsJson(in.scene, in.baked->maps);
  return report;
}

nlohmann::json provenanceOf(nlohmann::json report) {
  for (const char* key : kRunKeys) report.erase(key);
  report["direct"].erase("seconds");
  return report;
}

}  // namespace lucarne
