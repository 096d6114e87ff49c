#include "app/view/render.h"

#include <cstdio>
#include <map>
#include <memory>

#include "base/error.h"
#include "base/log.h"
#include "base/units.h"
#include "cli/commands.h"

namespace lucarne {
namespace {

void parseSize(const std::string& text, RenderOptions& options) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &options.width, &options.height, &rest) != 2 || options.width < 1 || options.height < 1)
    throw UsageError("--size must be WIDTHxHEIGHT, like 1280x720, not '" + text + "'");
}

void report(const RenderJob& job, const RenderStats& stats) {
  logInfo("wrote " + job.output.string() + " with " + stats.driver + ": frame " + formatNumber(1000 * stats.frameSeconds) + " ms, " +
          std::to_string(stats.counts.draws) + " draws, " + std::to_string(stats.counts.directionSwitches) + " direction switches (" +
          std::to_string(stats.unsorted.directionSwitches) + " unsorted), " + formatBytes(stats.textureBytes) + " of textures");
}

}  // namespace

void addRender(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("render", "make a picture of light maps, without a display");
  const auto job = std::make_shared<RenderJob>();
  const auto size = std::make_shared<std::string>("1280x720");
  const auto quiet = std::make_shared<bool>(false);
  cmd->add_option("DLM", job->dlm, "the light maps")->required();
  cmd->add_option("-o,--output", job->output, "IMAGE.exr (linear cd/m²) or IMAGE.png (exposed and tone mapped)")->required();
  cmd->add_option("--camera", job->camera, "name or number (from 0) of a camera of the scene; none: the first, or one that sees the scene");
  cmd->add_option("--size", *size, "WIDTHxHEIGHT")->capture_default_str();
  static const std::map<std::string, RendererKind> renderers{{"singlepass", RendererKind::singlepass}, {"multipass", RendererKind::multipass}};
  cmd->add_option("--renderer", job->options.renderer, "singlepass, or multipass: the paper's, one pass a direction")
      ->transform(CLI::CheckedTransformer(renderers).description(""))->type_name("NAME")->default_str("singlepass");
  static const std::map<std::string, LightMapFormat> formats{
      {"half", LightMapFormat::half}, {"rgb9e5", LightMapFormat::rgb9e5}, {"float", LightMapFormat::float32}};
  cmd->add_option("--map-format", job->options.format, "light maps on the GPU: half, rgb9e5 (half the memory) or float (exact)")
      ->transform(CLI::CheckedTransformer(formats).description(""))->type_name("NAME")->default_str("half");
  cmd->add_flag("--quiet", *quiet, "print errors only");
  cmd->callback([=, &action] {
    action = [=] {
      setQuiet(*quiet);
      parseSize(*size, job->options);
      report(*job, render(*job));
    };
  });
}

}  // namespace lucarne
