#include "cli/view/animation.h"

#include "base/error.h"
#include "base/log.h"

namespace lucarne {
namespace {

void check(const AnimationJob& job, const RenderJob& picture) {
  if (job.replay.empty()) {
    if (!job.benchmark.empty()) throw UsageError("--benchmark goes with --replay");
    if (picture.output.empty()) throw UsageError("-o is required: IMAGE.exr or IMAGE.png");
    return;
  }
  if (job.output.empty() && job.benchmark.empty())
    throw UsageError("--replay needs -o FOLDER for its frames, or --benchmark F, or both");
  if (job.options.renderer == RendererKind::pathtraced)
    throw UsageError("--replay draws light maps; --renderer pathtraced makes single pictures");
}

void tell(const AnimationJob& job, const AnimationReport& report) {
  std::string text = std::to_string(report.frames) + " frames";
  if (!job.output.empty()) text += " in " + job.output.string();
  if (report.drawn < report.frames) text += ", " + std::to_string(report.frames - report.drawn) + " of them from before";
  logInfo(text + ", with " + report.stats.driver);
  if (job.output.empty()) return;
  logInfo(report.video.empty() ? "no video: ffmpeg is not installed" : "wrote " + report.video.string());
}

}  // namespace

void addAnimationArguments(CLI::App& cmd, AnimationJob& animation) {
  cmd.add_option("--replay", animation.replay,
                 "a walk from play --record: a picture for each frame of it, and walk.mp4 where ffmpeg is installed");
  cmd.add_option("--fps", animation.fps, "with --replay: frames a second")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  cmd.add_option("--benchmark", animation.benchmark, "with --replay: write frame times to this file (JSON); needs no -o");
}

bool animateIfAsked(AnimationJob animation, const RenderJob& picture) {
  animation.dlm = picture.dlm;
  animation.output = picture.output;
  animation.options = picture.options;
  animation.overlay = picture.overlay;
  check(animation, picture);
  if (animation.replay.empty()) return false;
  tell(animation, animate(animation));
  return true;
}

}  // namespace lucarne
