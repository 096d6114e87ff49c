#include "app/view/animate.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/view/video.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/image_file.h"
#include "base/json.h"
#include "base/log.h"
#include "base/units.h"
#include "player/path_frames.h"
#include "player/shown_scene.h"

namespace lucarne {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOrigin = "frames.json";  // in the folder: what its frames are of
constexpr std::size_t kMostFrames = 100'000;    // of five digits
constexpr std::size_t kFramesPerNote = 100;

fs::path frameFile(const fs::path& folder, std::size_t frame) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05zu.png", frame);
  return folder / name;
}

/// All that a frame depends on but the machine.
nlohmann::json originOf(const AnimationJob& job, const nlohmann::json& manifest) {
  const RenderOptions& o = job.options;
  return {{"format", "lucarne-frames"},
          {"version", 1},
          {"content_hash", manifest.value("content_hash", "")},
          {"replay_hash", hashBytes(readFile(job.replay)).hex()},
          {"fps", job.fps},
          {"size", {o.width, o.height}},
          {"renderer", static_cast<int>(o.renderer)},
          {"map_format", static_cast<int>(o.format)},
          {"lobe", static_cast<int>(o.lobe)},
          {"overlay", job.overlay}};
}

/// Makes the folder, or finds it with frames of the same origin.
void takeFolder(const fs::path& folder, const nlohmann::json& origin) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throwSystemError("make the folder", folder, failure.value());
  const fs::path file = folder / kOrigin;
  const std::string text = dumpJson(origin);
  if (fs::exists(file)) {
    const std::vector<std::uint8_t> bytes = readFile(file, 1 << 20);
    if (std::string(bytes.begin(), bytes.end()) == text) return;
    throw UsageError(folder.string() + " holds the frames of another animation; remove it or name another folder");
  }
  if (fs::exists(frameFile(folder, 0)))
    throw UsageError(folder.string() + " holds frames of an unknown origin; remove them or name another folder");
  writeFileAtomically(file, text);
}

std::size_t framesOf(const WalkPath& path, const AnimationJob& job) {
  const std::size_t count = frameCount(path, job.fps);
  if (count > kMostFrames)
    throw UsageError(job.replay.string() + " at --fps " + formatNumber(job.fps) + " has more than " +
                     std::to_string(kMostFrames) + " frames");
  return count;
}

Benchmark draw(const AnimationJob& job, const WalkPath& path, OpenedDlm& opened, AnimationReport& report) {
  const PathFramesOptions options{job.options, job.fps, job.overlay, photonsOf(opened.dlm.manifest)};
  const bool keeps = !job.output.empty();
  PathFramesSink sink;
  sink.isWanted = [&](std::size_t frame) { return !keeps || !fs::exists(frameFile(job.output, frame)); };
  sink.take = [&](std::size_t frame, const std::vector<std::uint8_t>& rgb) {
    if (keeps) writePng(frameFile(job.output, frame), job.options.width, job.options.height, rgb);
    if (++report.drawn % kFramesPerNote == 0)
      logInfo("frame " + std::to_string(frame + 1) + " of " + std::to_string(report.frames));
  };
  return drawPath(opened.dlm.scene, sourceOf(opened, job.options.format, 0, {}), path, options, sink);
}

}  // namespace

AnimationReport animate(const AnimationJob& job) {
  const WalkPath path = readWalkPath(job.replay);
  AnimationReport report;
  report.frames = framesOf(path, job);
  if (!job.benchmark.empty()) checkWritable(job.benchmark);
  OpenedDlm opened = openDlm(job.dlm, [](const std::string&, double) {});
  if (!job.output.empty()) takeFolder(job.output, originOf(job, opened.dlm.manifest));
  const Benchmark benchmark = draw(job, path, opened, report);
  report.stats = benchmark.stats;
  if (!job.benchmark.empty()) writeFileAtomically(job.benchmark, textOf(benchmark));
  if (!job.output.empty() && makeVideo(job.output, job.fps, job.output / "walk.mp4"))
    report.video = job.output / "walk.mp4";
  return report;
}

}  // namespace lucarne
