#include "app/bake_identity.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/system.h"
#include "distributed/build_info.h"
#include "distributed/probe_rays.h"
#include "tracer/scene/light_hash.h"
#include "tracer/transport/photon_hit.h"

namespace lucarne {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 5> kShapes = {"pyramid", "box", "epanechnikov", "adaptive", "linear"};
constexpr std::array<const char*, 2> kChartModes = {"auto", "grow"};
constexpr std::array<const char*, 2> kSamplers = {"random", "sobol"};
constexpr std::array<const char*, 2> kDirectModes = {"photons", "gathered"};
constexpr std::array<const char*, 2> kSeamModes = {"fit", "keep"};
constexpr std::array<const char*, 3> kLightParts = {"all", "direct", "indirect"};

/// The place of a view's text among names.
template <class T, std::size_t n>
T choiceAt(const JsonView& view, const std::array<const char*, n>& names) {
  const auto at = std::find(names.begin(), names.end(), view.text());
  if (at == names.end()) view.refuse("is none that this program knows");
  return static_cast<T>(at - names.begin());
}

/// As optionsOf(), with an InputError.
BakeOptions readOptions(const PartHeader& header, const std::string& file) {
  const JsonView s(header.identity.settings, file), r(header.identity.resolve, file);
  BakeOptions o;
  o.directions = static_cast<int>(s.at("directions").integer(1, 4096));
  o.texelsPerMetre = s.at("texels_per_metre").number();
  o.texelBudget = s.at("texel_budget").count();
  o.charts = choiceAt<ChartMode>(s.at("charts"), kChartModes);
  o.keepAllDirections = s.at("keep_all_directions").flag();
  o.directionFilter = choiceAt<DirectionFilter>(s.at("direction_filter"), kDirectionFilters);
  o.seed = s.at("seed").count();
  o.sampler = choiceAt<SamplerKind>(s.at("sampler"), kSamplers);
  o.light = choiceAt<LightPart>(s.at("light"), kLightParts);
  if (s.has("direct")) o.direct = choiceAt<DirectMode>(s.at("direct"), kDirectModes);
  if (s.has("moments")) o.moments = s.at("moments").flag();
  if (header.planned.samples > 0) o.directSamples = header.planned.samples;
  o.environmentHash = s.at("environment").text();
  if (!o.environmentHash.empty()) o.environment = header.environmentName;
  o.environmentScale = s.at("environment_scale").number();
  o.environmentTurn = s.at("environment_turn").number();
  o.guidedEmission = s.at("guided_emission").flag();
  o.guideHash = s.at("guide").text();
  o.kernel.shape = choiceAt<KernelShape>(r.at("kernel"), kShapes);
  o.kernel.width = r.at("kernel_width").number();
  if (r.has("drop_error")) o.dropError = r.at("drop_error").number();
  if (r.has("seams")) o.seams = choiceAt<SeamMode>(r.at("seams"), kSeamModes);
  o.photons = std::max<std::uint64_t>(1, header.planned.photons > 0 ? header.planned.photons : header.photons.end());
  if (traceSettings(o) != header.identity.settings) s.refuse("has settings that this program does not know");
  if (resolveSettings(o) != header.identity.resolve) r.refuse("has kernel settings that this program does not know");
  checkSettings(o);
  return o;
}

}  // namespace

json traceSettings(const BakeOptions& o) {
  json settings = {{"directions", o.directions},
          {"texels_per_metre", o.texelsPerMetre},
          {"texel_budget", o.texelBudget},
          {"charts", kChartModes[static_cast<std::size_t>(o.charts)]},
          {"keep_all_directions", o.keepAllDirections},
          {"direction_filter", nameOf(o.directionFilter)},
          {"seed", o.seed},
          {"sampler", kSamplers[static_cast<std::size_t>(o.sampler)]},
          {"environment", o.environmentHash},
          {"environment_scale", o.environmentScale},
          {"environment_turn", o.environmentTurn},
          {"guided_emission", o.guidedEmission},
          {"guide", o.guideHash},
          {"light", kLightParts[static_cast<std::size_t>(o.light)]},
          {"fixed_point_bits", kFixedPointBits},
          {"depth_limit", TraceLimits{}.depth}};
  if (gathersDirect(o)) settings["direct"] = kDirectModes[static_cast<std::size_t>(o.direct)];
  if (o.moments) settings["moments"] = true;
  return settings;
}

json resolveSettings(const BakeOptions& o) {
  json settings = {{"kernel", kShapes[static_cast<std::size_t>(o.kernel.shape)]}, {"kernel_width", o.kernel.width}};
  if (o.seams != SeamMode::fit) settings["seams"] = seamsName(o);
  if (o.dropError > 0) settings["drop_error"] = o.dropError;
  return settings;
}

std::string seamsName(const BakeOptions& o) { return kSeamModes[static_cast<std::size_t>(o.seams)]; }

BakeIdentity identityOf(const BakeOptions& options, const PhotonScene& scene, const BakePlan& plan) {
  return {lightHash(scene.scene()), traceSettings(options), resolveSettings(options), layoutHash(plan),
          scene.emitters().totalFlux()};
}

Maker makerOf(const PhotonScene& scene) {
  return {buildName(), scene.rayCaster().description(), cpuName(), probeRays(scene)};
}

BakeOptions optionsOf(const PartHeader& header, const std::string& file) {
  try {
    return readOptions(header, file);
  } catch (const UsageError& error) {
    throw Error(ExitCode::mergeRefused, file + " has settings that no bake has: " + error.what());
  } catch (const Error& error) {
    throw Error(ExitCode::mergeRefused, error.what());
  }
}

}  // namespace lucarne
