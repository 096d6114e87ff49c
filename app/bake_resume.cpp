#include "app/bake_resume.h"

#include "app/bake_identity.h"
#include "app/bake_report.h"
#include "app/part_scene.h"
#include "app/report_files.h"
#include "app/scene_difference.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/units.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"

namespace lucarne {
namespace {

/// What keeps a state from going on; empty where nothing does. It goes on only in the program and on the processor that
/// trace as it was traced.
std::string differenceOf(const PartHeader& wanted, const PartHeader& found) {
  BakeIdentity traced = found.identity;
  traced.resolve = wanted.identity.resolve;  // no photon depends on it
  std::string what = difference(wanted.identity, traced);
  for (const Maker& here : wanted.makers) {
    for (const Maker& there : found.makers) {
      if (what.empty() && here.build != there.build) what = "build: " + here.build + " and " + there.build;
      if (what.empty() && here.rayCaster != there.rayCaster)
        what = "ray_caster: " + here.rayCaster + " and " + there.rayCaster;
      if (what.empty() && here.probeRays != there.probeRays)
        what = "probe_rays: " + here.probeRays.hex() + " and " + there.probeRays.hex();
    }
  }
  return what;
}

void checkSameBake(const PartHeader& wanted, const Scene& scene, const PartHeader& found, const std::string& file) {
  std::string what = differenceOf(wanted, found);
  if (what.empty()) return;
  if (wanted.identity.scene != found.identity.scene)
    what = "the scene (" + someOf(sceneDifferences(sceneOfPart(PartReader(file)), scene)) + ")";
  throw Error(ExitCode::mergeRefused, "cannot go on: this bake and " + file + " differ in " + what +
                                          "; bake as before, name another output, or start anew without --resume");
}

/// Times and rates of the run that made it, where its report is still there.
void keepTimes(const BakeOptions& options, nlohmann::json& report) {
  for (const char* key : kRunKeys) report[key] = 0;
  if (!options.report) return;
  const std::filesystem::path file = reportFiles(*options.report).json;
  try {
    const auto bytes = readFile(file);
    const nlohmann::json earlier = parseJson(bytes, file.string());
    if (!earlier.is_object() || earlier.value("content_hash", "") != report["content_hash"]) return;
    for (const char* key : kRunKeys)
      if (earlier.contains(key)) report[key] = earlier[key];
    if (earlier.contains("rate_curve")) report["rate_curve"] = earlier["rate_curve"];
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
         manifest.value("scene_file_hash", "") == header.sceneFile.hex() &&
         manifest.value("settings_hash", "") == header.identity.settingsHash().hex() && isEnded(manifest, options) &&
         (!header.direct || sampleRanges(manifest) == toJson(IndexSet(samplesOf(options))));
}

/// The state that a finished part is; nothing where there is none.
std::optional<PartHeader> loadPart(const BakeOptions& options, const Scene& scene, const PartHeader& wanted,
                                   Tallies& tallies) {
  const std::filesystem::path path = partPath(options);
  if (!isPart(path)) return std::nullopt;
  const PartReader part(path);
  checkSameBake(wanted, scene, part.header(), path.string());
  addPart(part, tallies);
  return part.header();
}

void adopt(PartHeader& header, const PartHeader& found) {
  header.rates = found.rates;
  header.makers.insert(found.makers.begin(), found.makers.end());
  header.photons = found.photons;
  header.ledger = found.ledger;
  header.microseconds = found.microseconds;
  header.direct = found.direct;
}

/// True for a part of this bake that holds just the photons and samples that are asked for.
bool holdsAll(const BakeOptions& options, const PartHeader& wanted, const PartHeader& found) {
  return differenceOf(wanted, found).empty() && toJson(found.photons) == toJson(IndexSet(photonsOf(options))) &&
         (!found.direct || toJson(found.direct->samples) == toJson(IndexSet(samplesOf(options))));
}

/// Takes the tallies of a finished part that holds all, where there is one; a damaged one is as good as none.
void takeFinishedPart(const BakeOptions& options, BakeState& state) {
  const std::filesystem::path path = partPath(options);
  try {
    if (!isPart(path)) return;
    const PartReader part(path);
    if (!holdsAll(options, state.header, part.header())) return;
    addPart(part, state.tallies);
    adopt(state.header, part.header());
    logInfo(path.string() + " holds these " + formatCount(state.header.photons.count()) +
            " photons of this scene: light maps are made of it, nothing is traced");
  } catch (const InputError& error) {
    state.tallies.clear();
    logWarning(std::string(error.what()) + "; tracing instead");
  }
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
  manifest["peak_memory_bytes"] = peakMemoryBytes();
  logInfo(options.output.string() + " is finished already; nothing to trace");
  return manifest;
}

void takeUp(const BakeOptions& options, const Scene& scene, CheckpointFolder& folder, BakeState& state) {
  const std::optional<PartHeader> before = folder.peek();
  if (before && !options.resume) {
    folder.open();
    const std::filesystem::path old = folder.moveAside();
    logWarning("an interrupted bake with " + formatCount(before->photons.count()) + " photons was moved to " +
               old.string() + "; to go on with it, move it back and give --resume");
  }
  const bool used = options.checkpointSeconds > 0 || (options.resume && before);
  if (used) folder.open();
  if (!options.resume) {
    if (!writesPart(options)) takeFinishedPart(options, state);
    return;
  }
  const PartHeader wanted = state.header;
  std::optional<PartHeader> found = folder.load(
      state.tallies, [&](const PartHeader& h, const std::string& at) { checkSameBake(wanted, scene, h, at); });
  std::string file = folder.path().string();
  if (!found) {
    found = loadPart(options, scene, wanted, state.tallies);
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
