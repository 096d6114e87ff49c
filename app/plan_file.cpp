#include "app/plan_file.h"

#include "app/bake_environment.h"
#include "app/bake_identity.h"
#include "app/bake_report.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "dlm/dlm_writer.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFormat = "lucarne-plan";
constexpr std::uint64_t kVersion = 1, kMostBytes = 1 << 20;

struct Plan {
  PartHeader header;  // identity, what is planned, names, one maker
  fs::path scene, environment;
  DlmFormat format;
  std::string isa;
};

Hash128 hashAt(const JsonView& view) {
  const std::optional<Hash128> hash = Hash128::parse(view.text());
  if (!hash) view.refuse("must be 32 hexadecimal digits");
  return *hash;
}

MapFormat formatAt(const JsonView& view) {
  for (const MapFormat f : {MapFormat::half, MapFormat::float32, MapFormat::rgb9e5, MapFormat::ldr8})
    if (view.text() == nameOf(f)) return f;
  view.refuse("is none that this program knows");
}

Plan planFrom(const JsonView& v) {
  if (v.at("format").text() != kFormat) v.at("format").refuse("is not that of a plan");
  if (v.at("version").count() != kVersion) v.at("version").refuse("is one that this program does not know");
  Plan plan;
  PartHeader& h = plan.header;
  h.sceneName = v.at("scene_name").text();
  h.environmentName = v.at("environment_name").text();
  h.identity = {hashAt(v.at("scene_hash")), v.at("settings").json(), v.at("resolve").json(),
                hashAt(v.at("layout_hash")), v.at("emitted_flux_lm").number()};
  h.planned.photons = v.at("photons").count();
  if (v.has("direct_samples")) h.planned.samples = v.at("direct_samples").count();
  h.makers = {{v.at("build").text(), v.at("ray_caster").text(), v.at("processor").text(), hashAt(v.at("probe_rays"))}};
  plan.scene = v.at("scene").text();
  plan.environment = v.at("environment").text();
  plan.format.directional = formatAt(v.at("map_format"));
  plan.format.kMax = v.at("k_max").number();
  plan.isa = v.at("isa").text();
  return plan;
}

Plan readPlan(const fs::path& path) {
  const std::vector<std::uint8_t> bytes = readFile(path, kMostBytes);
  const json document = parseJson(bytes, path.string());
  return planFrom(JsonView(document, path.string()));
}

/// A path of the plan, seen from its folder.
fs::path placed(const fs::path& planFile, const fs::path& path) {
  return path.is_absolute() ? path : (planFile.parent_path() / path).lexically_normal();
}

/// As `folder` sees it; absolute where the two have nothing in common.
std::string seenFrom(const fs::path& folder, const fs::path& path) {
  std::error_code failed;
  const fs::path relative = fs::proximate(path, folder, failed);
  return (failed ? fs::absolute(path) : relative).string();
}

/// Options of the command line, and the member of settingsOfResult() that each decides.
struct Named {
  const char *option, *member;
};
constexpr Named kNamed[] = {{"--photons", "photons"},
                            {"--directions", "directions"},
                            {"--density", "texels_per_metre"},
                            {"--texels", "texel_budget"},
                            {"--charts", "charts"},
                            {"--keep-all-directions", "keep_all_directions"},
                            {"--direction-filter", "direction_filter"},
                            {"--moments", "moments"},
                            {"--seed", "seed"},
                            {"--sampler", "sampler"},
                            {"--light", "light"},
                            {"--direct", "direct"},
                            {"--direct-samples", "direct_samples"},
                            {"--environment-scale", "environment_scale"},
                            {"--environment-turn", "environment_turn"},
                            {"--no-guide", "guided_emission"},
                            {"--kernel", "kernel"},
                            {"--kernel-width", "kernel_width"},
                            {"--seams", "seams"},
                            {"--drop-error", "drop_error"},
                            {"--format", "format"},
                            {"--kmax", "k_max"},
                            {"--isa", "isa"}};

json settingsOfResult(const BakeOptions& o) {
  json all = traceSettings(o);
  all.update(resolveSettings(o));
  all["photons"] = o.photons;
  all["direct"] = o.direct == DirectMode::gathered ? "gathered" : "photons";
  all["direct_samples"] = o.directSamples;
  all["moments"] = o.moments;
  all["seams"] = seamsName(o);
  all["drop_error"] = o.dropError;
  all["format"] = nameOf(o.format.directional);
  all["k_max"] = o.format.kMax;
  all["isa"] = o.isa;
  return all;
}

/// The settings of one, everything else of the other.
BakeOptions joined(BakeOptions into, const BakeOptions& settings) {
  into.photons = settings.photons;
  into.directions = settings.directions;
  into.chooseDirections = false;
  into.texelsPerMetre = settings.texelsPerMetre;
  into.texelBudget = settings.texelBudget;
  into.charts = settings.charts;
  into.keepAllDirections = settings.keepAllDirections;
  into.directionFilter = settings.directionFilter;
  into.moments = settings.moments;
  into.kernel = settings.kernel;
  into.seams = settings.seams;
  into.dropError = settings.dropError;
  into.seed = settings.seed;
  into.sampler = settings.sampler;
  into.light = settings.light;
  into.direct = settings.direct;
  into.directSamples = settings.directSamples;
  into.environmentScale = settings.environmentScale;
  into.environmentTurn = settings.environmentTurn;
  into.guidedEmission = settings.guidedEmission;
  into.format = settings.format;
  into.isa = settings.isa;
  return into;
}

BakeOptions optionsOf(const Plan& plan, const fs::path& path) {
  try {
    BakeOptions o = lucarne::optionsOf(plan.header, path.string());
    o.format = plan.format;
    o.isa = plan.isa;
    checkMachine(o);
    return o;
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

}  // namespace

json planOf(const BakeOptions& o, const PartHeader& header, const fs::path& folder) {
  const fs::path base = folder.empty() ? fs::path(".") : folder;
  const Maker& maker = *header.makers.begin();
  json plan = {{"format", kFormat},
               {"version", kVersion},
               {"scene", o.scene ? seenFrom(base, *o.scene) : std::string()},
               {"scene_name", header.sceneName},
               {"scene_hash", header.identity.scene.hex()},
               {"environment", o.environment ? seenFrom(base, *o.environment) : std::string()},
               {"environment_name", header.environmentName},
               {"settings", header.identity.settings},
               {"resolve", header.identity.resolve},
               {"layout_hash", header.identity.layout.hex()},
               {"emitted_flux_lm", header.identity.emittedFlux},
               {"photons", o.photons},
               {"map_format", nameOf(o.format.directional)},
               {"k_max", o.format.kMax},
               {"isa", o.isa},
               {"build", maker.build},
               {"ray_caster", maker.rayCaster},
               {"processor", maker.processor},
               {"probe_rays", maker.probeRays.hex()}};
  if (gathersDirect(o)) plan["direct_samples"] = o.directSamples;
  return plan;
}

BakeOptions withPlan(const BakeOptions& given, const std::set<std::string>& typed, const fs::path& path) {
  const Plan plan = readPlan(path);
  const BakeOptions planned = optionsOf(plan, path);
  json wanted = settingsOfResult(given);
  const json fixed = settingsOfResult(planned);
  if (given.chooseDirections) wanted["directions"] = fixed["directions"];
  for (const Named& n : kNamed) {
    if (!typed.contains(n.option) || wanted[n.member] == fixed[n.member]) continue;
    throw UsageError(std::string(n.option) + " contradicts " + path.string() + ", which has " + n.member + " " +
                     fixed[n.member].dump() + "; leave it out, or make another plan");
  }
  BakeOptions o = joined(given, planned);
  o.plan = path;
  if (!o.scene && !plan.scene.empty()) o.scene = placed(path, plan.scene);
  if (!o.environment && !plan.environment.empty()) o.environment = placed(path, plan.environment);
  return o;
}

void checkAgainstPlan(const fs::path& path, const PartHeader& header) {
  const Plan plan = readPlan(path);
  const Maker &there = *plan.header.makers.begin(), &here = *header.makers.begin();
  if (const std::string what = difference(plan.header.identity, header.identity); !what.empty()) {
    const bool layout = what.starts_with("layout") || what.starts_with("emitted");
    throw Error(ExitCode::mergeRefused,
                path.string() + " and this bake differ in " + what + "; " +
                    (layout ? "they are of different versions of Lucarne (" + there.build + " and " + here.build + ")"
                            : std::string("bake the scene and sky that were planned, or make another plan")));
  }
  if (there.probeRays != here.probeRays)
    logWarning("this machine traces rays otherwise than the one that made " + path.string() + " (" + there.rayCaster +
               " and " + here.rayCaster + "): the light maps are as good as any, but not those of a single machine");
}

}  // namespace lucarne
