#include "app/bake_resume.h"

#include "app/bake_identity.h"
#include "app/bake_report.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/units.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"

namespace lucarne {
namespace {

/// A state goes on only in the program and on the processor that trace as it was traced.
void checkSameBake(const PartHeader& wanted, const PartHeader& found, const std::string& file) {
  std::string what = difference(wanted.identity, found.identity, {kResolveMembers.begin(), kResolveMembers.end()});
  for (const Maker& here : wanted.makers) {
    for (const Maker& there : found.makers) {
      if (what.empty() && here.build != there.build) what = "build: " + here.build + " and " + there.build;
      if (what.empty() && here.rayCaster != there.rayCaster)
        what = "ray_caster: " + here.rayCaster + " and " + there.rayCaster;
      if (what.empty() && here.probeRays != there.probeRays)
        what = "probe_rays: " + here.probeRays.hex() + " and " + there.probeRays.hex();
    }
  }
  if (what.empty()) return;
  throw Error(ExitCode::mergeRefused, "cannot go on: this bake and " + file + " differ in " + what +
                                          "; bake as before, name another output, or start anew without --resume");
}

/// Times and rates of the run that made it, where its report is still there.
void keepTimes(const BakeOptions& options, nlohmann::json& report) {
  for (const char* key : kRunKeys) report[key] = 0;
  if (!options.report) return;
  try {
    const auto bytes = readFile(*options.report);
    const nlohmann::json earlier = parseJson(bytes, options.report->string());
    if (!earlier.is_object() || earlier.value("content_hash", "") != report["content_hash"]) return;
    for (const char* key : kRunKeys)
      if (earlier.contains(key)) report[key] = earlier[key];
    if (earlier.contains("direct")) report["direct"] = earlier["direct"];
  } catch (const std::exception&) {
    return;  // no earlier report: the times are not known any more
  }
}

nlohmann::json sampleRanges(const nlohmann::json& manifest) {
  const nlohmann::json direct = manifest.value("direct", nlohmann::json());
  return direct.is_object() ? direct.value("sample_ranges", nlohmann::json()) : nlohmann::json();
}

/// Whether the photons are those that the options ask for: all, or a beginning that a rule of theirs ended.
bool isEnded(const nlohmann::json& manifest, const BakeOptions& options) {
  const IndexRange range = photonsOf(options);
  const nlohmann::json ranges = manifest.value("photon_ranges", nlohmann::json());
  if (ranges == nlohmann::json::array({{range.begin, range.end}})) return true;
  const nlohmann::json end = manifest.value("ended_by", nlohmann::json());
  const bool byRule = (end == nameOf(JobEnd::time) && options.timeLimit) ||
                      (end == nameOf(JobEnd::targetError) && options.targetError > 0);
  return byRule && ranges.is_array() && ranges.size() == 1 && ranges[0].is_array() && ranges[0].size() == 2 &&
         ranges[0][0] == range.begin;
}

bool isOf(const nlohmann::json& manifest, const BakeOptions& options, const PartHeader& header) {
  const nlohmann::json settings = manifest.value("settings", nlohmann::json::object());
  if (!settings.is_object()) return false;
  nlohmann::json wanted = resolveSettings(options);
  wanted["seams"] = seamsName(options);
  wanted.update(formatSettings(options.format));
  wanted.update(stopSettings(options));
  if (gathersDirect(options)) wanted["direct_samples"] = options.directSamples;
  for (const auto& [key, value] : wanted.items())
    if (settings.value(key, nlohmann::json()) != value) return false;
  if (settings.contains("time_seconds") != options.timeLimit.has_value()) return false;
  if (settings.contains("target_error") != (options.targetError > 0)) return false;
  return manifest.value("scene_hash", "") == header.identity.scene.hex() &&
         manifest.value("settings_hash", "") == header.identity.settingsHash().hex() && isEnded(manifest, options) &&
         (!header.direct || sampleRanges(manifest) == toJson(IndexSet(samplesOf(options))));
}

/// The state that a finished part is; nothing where there is none.
std::optional<PartHeader> loadPart(const BakeOptions& options, const PartHeader& wanted, Tallies& tallies) {
  const std::filesystem::path path = partPath(options);
  if (!isPart(path)) return std::nullopt;
  const PartReader part(path);
  checkSameBake(wanted, part.header(), path.string());
  addPart(part, tallies);
  return part.header();
}

void adopt(PartHeader& header, const PartHeader& found) {
  header.makers.insert(found.makers.begin(), found.makers.end());
  header.photons = found.photons;
  header.ledger = found.ledger;
  header.microseconds = found.microseconds;
  header.direct = found.direct;
}

}  // namespace

std::optional<nlohmann::json> finishedBefore(const BakeOptions& options, const PartHeader& header) {
  if (!options.resume || writesPart(options) || options.keepPart || !holdsLightMaps(options.output))
    return std::nullopt;
  nlohmann::json manifest = readManifest(options.output);
  if (!isOf(manifest, options, header)) return std::nullopt;
  for (const char* key : {"format", "version", "frame", "charts", "sides", "irradiance", "directional", "files"})
    manifest.erase(key);
  manifest["charts"] = readManifest(options.output)["charts"]["count"];
  manifest["directions"] = options.directions;
  keepTimes(options, manifest);
  logInfo(options.output.string() + " is finished already; nothing to trace");
  return manifest;
}

void takeUp(const BakeOptions& options, CheckpointFolder& folder, BakeState& state) {
  const std::optional<PartHeader> before = folder.peek();
  if (before && !options.resume) {
    folder.open();
    const std::filesystem::path old = folder.moveAside();
    logWarning("an interrupted bake with " + formatCount(before->photons.count()) + " photons was moved to " +
               old.string() + "; to go on with it, move it back and give --resume");
  }
  const bool used = options.checkpointSeconds > 0 || (options.resume && before);
  if (used) folder.open();
  if (!options.resume) return;
  const PartHeader wanted = state.header;
  std::optional<PartHeader> found =
      folder.load(state.tallies, [&](const PartHeader& h, const std::string& file) { checkSameBake(wanted, h, file); });
  std::string file = folder.path().string();
  if (!found) {
    found = loadPart(options, wanted, state.tallies);
    file = partPath(options).string();
  }
  if (!found) {
    logInfo("no state to go on with: starting anew");
    return;
  }
  adopt(state.header, *found);
  remaining(state, photonsOf(options), file);
  if (state.header.direct) remainingSamples(state, samplesOf(options), file);
  logInfo("going on from " + formatCount(found->photons.count()) + " photons in " + file);
}

}  // namespace lucarne
