#include "app/merge.h"

#include <chrono>

#include "app/bake_identity.h"
#include "app/bake_outputs.h"
#include "app/bake_report.h"
#include "app/merge_gaps.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/units.h"
#include "distributed/build_info.h"
#include "distributed/merge.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

bool toPart(const MergeOptions& options) { return options.output && options.output->extension() == ".part"; }

/// Asked before the work.
void checkOutput(const MergeOptions& options, const std::vector<fs::path>& inputs) {
  if (options.report) checkWritable(*options.report);
  if (!options.output) return;
  checkWritable(*options.output);
  std::error_code none;
  for (const fs::path& input : inputs) {
    if (fs::equivalent(input, *options.output, none)) {
      throw UsageError(options.output->string() +
                       " is both a part to merge and the output; inputs are never touched: name another output");
    }
  }
  if (!fs::exists(*options.output)) return;
  if (toPart(options) ? !isPart(*options.output) : !holdsLightMaps(*options.output)) {
    throw Error(ExitCode::failed, "will not replace " + options.output->string() + ": it is not " +
                                      (toPart(options) ? "a part of a bake" : "a folder of light maps") +
                                      "; remove it or name another");
  }
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

/// The kernel as asked for, or as the parts have it.
void chooseKernel(const MergeOptions& options, PartHeader& whole) {
  BakeOptions o = optionsOf(whole);
  if (options.kernel) o.kernel.shape = *options.kernel;
  if (options.kernelWidth) o.kernel.width = *options.kernelWidth;
  checkSettings(o);
  whole.identity.resolve = resolveSettings(o);
}

/// Light maps of the sum. The layout is made again from the scene; it must be the one that the tallies are of.
nlohmann::json writeMaps(const MergeOptions& options, const PartHeader& whole, const std::vector<std::uint8_t>& glb,
                         const Tallies& tallies) {
  BakeOptions o = optionsOf(whole);
  o.format = options.format;
  const Scene scene = readGlb(glb, "the scene of the parts");
  // Every chart has a side with texels in the tallies, so an honest layout has no more than those.
  const BakePlan plan = makePlan(scene, o, whole.texels);
  if (layoutHash(plan) != whole.identity.layout) {
    throw Error(ExitCode::mergeRefused, "the parts were laid out by " + whole.makers.begin()->build +
                                            ", and this program, " + buildName() +
                                            ", lays the scene out otherwise: merge with that one, or bake again");
  }
  const Baked baked = resolveBake(scene, plan, o, whole.identity.emittedFlux, whole.ledger, tallies);
  nlohmann::json report = makeReport({o, scene, plan, whole, &baked});
  writeDlm(*options.output, scene, baked.uv, baked.maps, provenanceOf(report), options.format);
  return report;
}

/// Of a merge that made no maps.
nlohmann::json shortReport(const PartHeader& whole) {
  nlohmann::json report = toJson(whole);
  report["photons"] = whole.ledger.photons;
  report["seconds"] = static_cast<double>(whole.microseconds) * 1e-6;
  return report;
}

}  // namespace

nlohmann::json merge(const MergeOptions& options) {
  const std::vector<fs::path> files = partFiles(options.inputs);
  checkOutput(options, files);
  PartSet parts = joinParts(files, !options.kernel && !options.kernelWidth);
  PartHeader& whole = parts.whole;
  tellOf(whole, options, files[0].parent_path());
  ReadingRate rate((whole.tallyBytes() + whole.sceneBytes) * files.size());
  nlohmann::json report;
  if (!options.output) {
    verifyParts(parts, std::ref(rate));
    report = shortReport(whole);
    report.erase("content_hash");
  } else {
    chooseKernel(options, whole);
    checkMemory(whole, !toPart(options));
    Tallies tallies(whole.lightEntries, whole.texels);
    const std::vector<std::uint8_t> glb = sumParts(parts, tallies, std::ref(rate));
    whole.content = tallies.contentHash();
    if (toPart(options)) {
      writePart(*options.output, whole, glb, tallies);
      report = shortReport(whole);
    } else {
      report = writeMaps(options, whole, glb, tallies);
    }
  }
  report["parts"] = files.size();
  report["missing_photons"] = toJson(missingPhotons(whole));
  report["merge_seconds"] = rate.elapsed();
  report["peak_memory_bytes"] = peakMemoryBytes();
  if (options.report) writeFileAtomically(*options.report, dumpJson(report));
  return report;
}

}  // namespace lucarne
