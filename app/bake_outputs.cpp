#include "app/bake_outputs.h"

#include "app/bake_report.h"
#include "app/bake_rescue.h"
#include "app/report_writing.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files.h"
#include "base/log.h"
#include "base/memory.h"

namespace lucarne {
namespace {

/// The states hold the end of the bake unless they were turned off or the disk failed: then it is written now.
void publishPart(const BakeOptions& options, const PackedScene& packed, const BakeState& state,
                 CheckpointFolder& folder, bool saved) {
  if (saved) {
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
  if (options.report) checkReport(*options.report);
}

nlohmann::json writeMaps(const BakeSetup& setup, const BakeState& state, const std::filesystem::path& path,
                         JobEnd end) {
  const BakeOptions& options = setup.options;
  const PackedScene& packed = setup.packed;
  const BakePlan& plan = setup.plan;
  checkMapsOutput(path);
  PartHeader header = state.header;
  header.content = state.tallies.contentHash();
  const Baked baked = resolveBake(packed.scene, plan, options, header, state.tallies, setup.contacts.get());
  nlohmann::json report = makeReport({options, packed.scene, plan, header, &baked});
  // Of all its photons a bake is what a merge of them is, to the last bit.
  if (end != JobEnd::photons) report["ended_by"] = nameOf(end);
  removeTemporaries(resolveTarget(path));
  writeDlm(path, packed.scene, baked.uv, baked.maps, provenanceOf(report), options.format);
  return report;
}

namespace {

/// The report of all but the outputs, which are written; of a part the light maps, where there is a report.
struct Written {
  nlohmann::json report;
  std::optional<LightMaps> maps;
};

Written writeOutputs(const BakeSetup& setup, const BakeState& state, CheckpointFolder& folder,
                            const JobResult& result) {
  const BakeOptions& options = setup.options;
  Written written;
  nlohmann::json& report = written.report;
  if (!writesPart(options)) {
    report = writeMaps(setup, state, options.output, result.end);
  } else if (options.report) {
    Baked baked =
        resolveBake(setup.packed.scene, setup.plan, options, state.header, state.tallies, setup.contacts.get());
    report = makeReport({options, setup.packed.scene, setup.plan, state.header, &baked});
    written.maps = std::move(baked.maps);
  } else {
    report = makeReport({options, setup.packed.scene, setup.plan, state.header, nullptr});
  }
  report["ended_by"] = nameOf(result.end);
  setup.control.mayEndAtOnce("");
  if (writesPart(options) || options.keepPart) publishPart(options, setup.packed, state, folder, result.saved);
  return written;
}

/// A full disk gets a second try without the older of the saved states.
Written writeOutputsOnFullDisk(const BakeSetup& setup, const BakeState& state, CheckpointFolder& folder,
                                      const JobResult& result) {
  try {
    return writeOutputs(setup, state, folder, result);
  } catch (const Error& error) {
    if (error.code() != ExitCode::outOfResource || !result.saved) throw;
    folder.keepNewest();
    return writeOutputs(setup, state, folder, result);
  }
}

}  // namespace

nlohmann::json finish(const BakeSetup& setup, BakeState& state, CheckpointFolder& folder, const JobResult& result) {
  state.header.content = state.tallies.contentHash();
  const std::string saved = howToGoOn(state, folder.path().string());
  if (result.saved) setup.control.mayEndAtOnce("interrupted while the result was written; all " + saved);
  const auto fail = [&](ExitCode code, const std::string& what) {
    setup.control.mayEndAtOnce("");
    return Error(code, what + "; " + (result.saved ? "all " + saved : rescueState(setup, state, folder)));
  };
  Written written;
  try {
    written = writeOutputsOnFullDisk(setup, state, folder, result);
  } catch (const Error& error) {
    throw fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    throw fail(ExitCode::outOfResource, "not enough memory to make the light maps");
  }
  folder.remove();
  nlohmann::json& report = written.report;
  report["trace_variant_speedup"] = state.variantSpeedup;
  report["checkpoints"] = state.checkpoints;
  report["checkpoint_seconds"] = state.checkpointSeconds;
  report["peak_memory_bytes"] = peakMemoryBytes();
  const ReportContext context{setup.options, setup.scene, setup.plan, setup.player};
  return writeReport(context, state.header, written.maps ? &*written.maps : nullptr, std::move(report));
}

}  // namespace lucarne
