#include "app/bake_outputs.h"

#include "app/bake_report.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/memory.h"

namespace lucarne {
namespace {

/// The states hold the end of the bake unless they were turned off: then they are written now.
void publishPart(const BakeOptions& options, const PackedScene& packed, const BakeState& state,
                 CheckpointFolder& folder) {
  if (options.checkpointSeconds > 0) {
    folder.publish(partPath(options));
  } else {
    writePart(partPath(options), state.header, packed.glb, state.tallies);
  }
}

}  // namespace

void checkPartOutput(const std::filesystem::path& path, const std::optional<IndexSet>& photons) {
  checkWritable(path);
  if (!std::filesystem::exists(path)) return;
  if (!isPart(path))
    throw Error(ExitCode::failed,
                "will not replace " + path.string() + ": it is not a part of a bake; remove it or name another");
  if (!photons) return;
  try {
    const PartHeader there = PartReader(path).header();
    for (const IndexRange& r : there.photons.ranges()) {
      if (photons->contains(r)) continue;
      throw Error(ExitCode::failed, "will not replace " + path.string() + ": it holds other photons (" +
                                        toText(there.photons) + "); give each part a name of its own with -o");
    }
  } catch (const InputError&) {
    return;  // damaged: no loss
  }
}

void checkMapsOutput(const std::filesystem::path& path) {
  checkWritable(path);
  if (std::filesystem::exists(path) && !holdsLightMaps(path))
    throw Error(ExitCode::failed,
                "will not replace " + path.string() + ": it is not a folder of light maps; remove it or name another");
}

void checkOutputs(const BakeOptions& options) {
  if (writesPart(options) || options.keepPart) checkPartOutput(partPath(options), IndexSet(photonsOf(options)));
  if (!writesPart(options)) checkMapsOutput(options.output);
  if (options.report) checkWritable(*options.report);
}

nlohmann::json finish(const BakeOptions& options, const PackedScene& packed, const BakePlan& plan, BakeState& state,
                      CheckpointFolder& folder) {
  PartHeader& header = state.header;
  header.content = state.tallies.contentHash();
  std::optional<Baked> baked;
  const bool maps = !writesPart(options);
  if (maps || options.report) {
    baked = resolveBake(packed.scene, plan, options, header, state.tallies);
  }
  nlohmann::json report = makeReport({options, packed.scene, plan, header, baked ? &*baked : nullptr});
  if (maps) {
    removeTemporaries(resolveTarget(options.output));
    writeDlm(options.output, packed.scene, baked->uv, baked->maps, provenanceOf(report), options.format);
  }
  if (!maps || options.keepPart) publishPart(options, packed, state, folder);
  folder.remove();
  report["trace_variant_speedup"] = state.variantSpeedup;
  report["checkpoints"] = state.checkpoints;
  report["checkpoint_seconds"] = state.checkpointSeconds;
  return writeReport(options, report);
}

nlohmann::json writeReport(const BakeOptions& options, nlohmann::json report) {
  report["peak_memory_bytes"] = peakMemoryBytes();
  if (options.report) writeFileAtomically(*options.report, dumpJson(report));
  return report;
}

}  // namespace lucarne
