#include "app/merge.h"

#include <chrono>

#include "app/bake_identity.h"
#include "app/bake_outputs.h"
#include "app/bake_report.h"
#include "app/merge_gaps.h"
#include "app/report_writing.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/units.h"
#include "distributed/build_info.h"
#include "distributed/merge.h"
#include "tracer/scene/gltf_reader.h"
#include "tracer/scene/light_hash.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

bool toPart(const MergeOptions& options) { return options.output && options.output->extension() == ".part"; }

/// Inputs are never touched.
void checkNoInput(const std::optional<fs::path>& output, const char* what, const std::vector<fs::path>& inputs) {
  std::error_code none;
  for (const fs::path& input : inputs) {
    if (!output || !fs::equivalent(input, *output, none)) continue;
    throw UsageError(output->string() + " is both a part to merge and the " + what +
                     "; inputs are never touched: name another " + what);
  }
}

/// Asked before the work.
void checkOutput(const MergeOptions& options, const std::vector<fs::path>& inputs) {
  if (options.report) {
    const ReportFiles files = reportFiles(*options.report);
    checkNoInput(files.json, "report", inputs);
    checkNoInput(files.page, "report", inputs);
  }
  checkNoInput(options.output, "output", inputs);
  if (options.report) checkReport(*options.report);
  if (options.output)
    toPart(options) ? checkPartOutput(*options.output, std::nullopt) : checkMapsOutput(*options.output);
}

void checkMemory(const PartHeader& whole, bool resolves) {
  const std::uint64_t needed =
      whole.tallyBytes() + whole.sceneBytes + (resolves ? memoryOfMaps(whole.tallyBytes()) : 0);
  const std::uint64_t available = availableMemoryBytes();
  if (needed <= available) return;
  throw Error(ExitCode::outOfResource, "merging needs " + formatBytes(needed) + " of memory and " +
                                           formatBytes(available) + " are free; --verify needs none");
}

/// What is unusual about the sum. Photons missing from a part are no news: more parts may follow.
void tellOf(const PartHeader& whole, const MergeOptions& options, const fs::path& folder) {
  if (const std::string warning = makersWarning(whole.makers); !warning.empty()) logWarning(warning);
  const std::string gaps = describeGaps(whole);
  if (gaps.empty()) return;
  const std::string mend = "; bake them with: " + commandsForGaps(whole, folder);
  if (options.complete) throw Error(ExitCode::mergeRefused, gaps + ", and --complete wants them all" + mend);
  if (toPart(options)) {
    logInfo("so far " + gaps);
  } else {
    logWarning(gaps + "; the result is valid with more noise" + mend);
  }
}

/// Tells now and then how much has been read.
class ReadingRate {
 public:
  explicit ReadingRate(std::uint64_t bytes) : whole_(bytes) {}
  void operator()(std::uint64_t bytes) {
    const double seconds = elapsed();
    if (seconds < shown_ + kInterval) return;
    shown_ = seconds;
    logInfo("read " + formatBytes(bytes) + " of " + formatBytes(whole_) + ", " +
            formatBytes(static_cast<std::uint64_t>(static_cast<double>(bytes) / seconds)) + "/s");
  }
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  static constexpr double kInterval = 5;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::uint64_t whole_;
  double shown_ = 0;
};

/// The kernel and the seams as asked for, or as the parts have them.
void chooseKernel(const MergeOptions& options, BakeOptions& baked, PartHeader& whole) {
  const bool wasAdaptive = baked.kernel.shape == KernelShape::adaptive;
  if (options.kernel) baked.kernel.shape = *options.kernel;
  if (wasAdaptive != (baked.kernel.shape == KernelShape::adaptive))
    baked.kernel.width = defaultKernelWidth(baked.kernel.shape);
  if (options.kernelWidth) baked.kernel.width = *options.kernelWidth;
  if (options.seams) baked.seams = *options.seams;
  if (options.dropError) baked.dropError = *options.dropError;
  checkSettings(baked);
  whole.identity.resolve = resolveSettings(baked);
}

/// Settings of resolving that the options give, so that the parts need not agree about them.
std::set<std::string> chosenMembers(const MergeOptions& options) {
  std::set<std::string> chosen;
  if (options.kernel) chosen.insert("kernel");
  if (options.kernelWidth) chosen.insert("kernel_width");
  if (options.seams) chosen.insert("seams");
  if (options.dropError) chosen.insert("drop_error");
  return chosen;
}

/// The scene and its layout, made again from what the parts carry; `name` is the part that errors speak of. The layout
/// must be the one that the tallies are of.
struct MergedScene {
  Scene scene;
  BakePlan plan;

  MergedScene(const std::vector<std::uint8_t>& glb, const BakeOptions& baked, const PartHeader& whole,
              const std::string& name)
      : scene(readScene(glb, name)), plan(makePlanWithin(scene, baked, whole.texels, name)) {
    if (lightHash(scene) != whole.identity.scene) throw Error(ExitCode::mergeRefused, altered(name));
    const bool sameSize = plan.tallies.lightEntries == whole.lightEntries && plan.tallies.texels == whole.texels &&
                          plan.tallies.momentEntries == whole.momentEntries;
    if (layoutHash(plan) == whole.identity.layout && sameSize) return;
    const std::string& build = whole.makers.begin()->build;
    throw Error(ExitCode::mergeRefused,
                build == buildName() ? altered(name)
                                     : name + " was laid out by " + build + ", and this program, " + buildName() +
                                           ", lays the scene out otherwise: merge with that one, or bake again");
  }

 private:
  static std::string altered(const std::string& name) {
    return name + " was altered: its tallies are not of its scene and settings; bake it again";
  }

  /// Every chart has a side with texels in the tallies, so an honest layout has no more than those.
  static BakePlan makePlanWithin(const Scene& scene, const BakeOptions& baked, std::uint64_t texels,
                                 const std::string& name) {
    try {
      return makePlan(scene, baked, texels);
    } catch (const Error&) {
      throw Error(ExitCode::mergeRefused, altered(name));
    }
  }

  static Scene readScene(const std::vector<std::uint8_t>& glb, const std::string& name) {
    try {
      return readGlb(glb, name + ": scene");
    } catch (const InputError& error) {
      throw Error(ExitCode::mergeRefused, error.what());
    }
  }
};

nlohmann::json writeMaps(const MergeOptions& options, const BakeOptions& baked, const MergedScene& merged,
                         const PartHeader& whole, const Tallies& tallies) {
  const Baked maps = resolveBake(merged.scene, merged.plan, baked, whole, tallies);
  nlohmann::json report = makeReport({baked, merged.scene, merged.plan, whole, &maps});
  writeDlm(*options.output, merged.scene, maps.uv, maps.maps, provenanceOf(report), options.format);
  return report;
}

/// What the parts say of the bake, and where its maps go.
BakeOptions optionsOfMaps(const MergeOptions& options, BakeOptions baked, const PartHeader& whole) {
  baked.format = options.format;
  baked.output = *options.output;
  baked.report = options.report;
  if (whole.sceneName != kBuiltinSceneName) baked.scene = whole.sceneName;
  return baked;
}

/// The report of light maps with its page; that of a part or a check is JSON alone.
nlohmann::json writeReportOfMaps(const BakeOptions& baked, const MergedScene& merged, const PartHeader& whole,
                                 const PlayerPictures& player, nlohmann::json report) {
  const PhotonScene scene(merged.scene, {baked.isa, true});
  return writeReport({baked, scene, merged.plan, player, !whole.environmentName.empty()}, whole, nullptr,
                     std::move(report));
}

/// Of a merge that made no maps.
nlohmann::json shortReport(const PartHeader& whole) {
  nlohmann::json report = toJson(whole);
  report["photons"] = whole.ledger.photons;
  report["seconds"] = static_cast<double>(whole.microseconds) * 1e-6;
  return report;
}

}  // namespace

nlohmann::json merge(const MergeOptions& options, const PlayerPictures& player) {
  const std::vector<fs::path> files = partFiles(options.inputs);
  checkOutput(options, files);
  PartSet parts = joinParts(files, chosenMembers(options));
  PartHeader& whole = parts.whole;
  const std::string name = files[0].string();
  BakeOptions baked = optionsOf(whole, name);
  tellOf(whole, options, files[0].parent_path());
  ReadingRate rate((whole.tallyBytes() + whole.sceneBytes) * files.size());
  const auto complete = [&](nlohmann::json report) {
    report["parts"] = files.size();
    report["missing_photons"] = toJson(missingPhotons(whole));
    if (whole.direct) report["missing_samples"] = toJson(missingSamples(whole));
    report["merge_seconds"] = rate.elapsed();
    report["peak_memory_bytes"] = peakMemoryBytes();
    return report;
  };
  const auto writeShort = [&](nlohmann::json report) {
    report = complete(std::move(report));
    if (options.report) writeFileAtomically(reportFiles(*options.report).json, dumpJson(report));
    return report;
  };
  if (!options.output) {
    verifyParts(parts, std::ref(rate));
    nlohmann::json report = shortReport(whole);
    report.erase("content_hash");
    return writeShort(std::move(report));
  }
  chooseKernel(options, baked, whole);
  checkMemory(whole, !toPart(options));
  if (toPart(options)) checkPartOutput(*options.output, whole.photons);
  Tallies tallies = whole.makeTallies();
  const std::vector<std::uint8_t> glb = sumParts(parts, tallies, std::ref(rate));
  whole.content = tallies.contentHash();
  if (toPart(options)) {
    writePart(*options.output, whole, glb, tallies);
    return writeShort(shortReport(whole));
  }
  baked = optionsOfMaps(options, std::move(baked), whole);
  const MergedScene merged(glb, baked, whole, name);
  nlohmann::json report = complete(writeMaps(options, baked, merged, whole, tallies));
  return options.report ? writeReportOfMaps(baked, merged, whole, player, std::move(report)) : report;
}

}  // namespace lucarne
