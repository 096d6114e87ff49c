#include "app/view/render.h"

#include "base/log.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/layout_options.h"
#include "cli/view/animation.h"
#include "cli/view/render_arguments.h"

namespace lucarne {
namespace {

void report(const RenderJob& job, const RenderReport& made) {
  const RenderStats& stats = made.stats;
  if (!made.scale.empty()) logInfo(std::string(nameOf(job.options.view.kind)) + ": " + made.scale);
  if (!made.otherwise.empty()) logInfo(made.otherwise);
  if (job.options.renderer == RendererKind::pathtraced) {
    logInfo("wrote " + job.output.string() + " with " + stats.driver + " in " + formatDuration(stats.frameSeconds));
    return;
  }
  logInfo("wrote " + job.output.string() + " with " + stats.driver + ": frame " +
          formatNumber(1000 * stats.frameSeconds) + " ms, " + std::to_string(stats.counts.draws) + " draws, " +
          std::to_string(stats.counts.directionSwitches) + " direction switches (" +
          std::to_string(stats.unsorted.directionSwitches) + " unsorted), " + formatBytes(stats.textureBytes) +
          " of textures");
}

}  // namespace

void addRender(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("render", "make a picture, or an animation, of light maps, without a display");
  const auto job = std::make_shared<RenderJob>();
  const auto size = std::make_shared<std::string>("1280x720");
  const auto quiet = std::make_shared<bool>(false);
  cmd->add_option("DLM", job->dlm, "the light maps; for pathtraced also a scene")->required();
  cmd->add_option("-o,--output", job->output, "IMAGE.exr (linear cd/m²), IMAGE.png (exposed and tone mapped), or with --replay a folder");
  cmd->add_option("--camera", job->camera,
                  "name or number (from 0) of a camera of the scene; none: the first, or one that sees the scene");
  addRenderArguments(*cmd, job->options, *size, true);
  addViewArguments(*cmd, job->options.view);
  addToneCurve(*cmd, job->display.curve);
  const auto exposure = std::make_shared<std::string>("auto");
  cmd->add_option("--exposure", *exposure,
                  "of .png: auto, or an exposure value at ISO 100 as of a camera (5: a lamp-lit room, 15: noon)")
      ->capture_default_str();
  cmd->add_option("--supersample", job->options.supersamples,
                  "so many samples a pixel, each way, for smooth edges; not of pathtraced")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  cmd->add_option("--samples", job->samples, "pathtraced: paths a pixel; four times as many halve the noise")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  cmd->add_flag("--overlay", job->overlay, "the text that play shows over the picture (.png), or over each with --replay");
  const auto animation = std::make_shared<AnimationJob>();
  addAnimationArguments(*cmd, *animation);
  const auto sky = std::make_shared<std::string>();
  addSkyOptions(*cmd, job->sky, *sky);
  cmd->add_option("--seed", job->sky.seed, "pathtraced: another seed gives other noise")->capture_default_str();
  cmd->add_option("--threads", job->sky.threads, "pathtraced: 0 for all")->capture_default_str();
  cmd->add_flag("--quiet", *quiet, "print errors only");
  cmd->callback([=, &action] {
    action = [=] {
      setQuiet(*quiet);
      applySize(*size, job->options);
      applyExposure(*exposure, job->display);
      if (animateIfAsked(*animation, *job)) return;
      finishSky(job->sky, *sky);
      checkSettings(job->sky);
      report(*job, render(*job));
    };
  });
}

}  // namespace lucarne
