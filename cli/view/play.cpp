#include <cstdio>

#include "app/view/walk.h"
#include "base/error.h"
#include "base/log.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/interrupts.h"
#include "cli/layout_options.h"
#include "cli/view/render_arguments.h"

namespace lucarne {

namespace {

void applyScale(const std::string& scale, PlayOptions& options) {
  if (scale == "auto") return;
  char rest = 0;
  if (std::sscanf(scale.c_str(), "%lf%c", &options.renderScale, &rest) != 1 || !(options.renderScale >= 0.1) ||
      !(options.renderScale <= 1))
    throw UsageError("--scale must be auto or a number from 0.1 to 1, not '" + scale + "'");
}

/// A signal closes the window, so that the walk is kept and the last frame saved.
PlayReport walkUntilEnded(const std::string& dlm, PlayOptions options, const BakeOptions& sky) {
  Interrupts interrupts(options.record.empty() ? "the window is closed" : "the walk is being saved");
  const JobControl control = interrupts.control();
  options.ended = control.stop;
  const PlayReport report = walk(dlm, options, sky);
  if (control.stop()) throw Error(ExitCode::interrupted, "interrupted");
  return report;
}

}  // namespace

void addPlay(CLI::App& app, Action& action) {
  CLI::App* cmd = app.add_subcommand("play", "walk through light maps in a window (mouse, W A S D; H shows the keys)");
  const auto dlm = std::make_shared<std::string>();
  const auto size = std::make_shared<std::string>("1280x720");
  const auto options = std::make_shared<PlayOptions>();
  cmd->add_option("DLM", *dlm, "the light maps")->required();
  cmd->add_option("--camera", options->camera, "name or number (from 0) of the camera to start at");
  cmd->add_flag("--fly", options->fly, "start flying, exactly at the camera, not on the floor near it");
  addRenderArguments(*cmd, options->render, *size, false);
  addViewArguments(*cmd, options->render.view);
  addToneCurve(*cmd, options->look.curve);
  const auto scale = std::make_shared<std::string>("auto");
  cmd->add_option(
         "--scale", *scale,
         "drawn pixels per window pixel, each way: lower is faster; auto: 1, and down to 0.5 while walking on a slow "
         "machine")
      ->capture_default_str();
  cmd->add_flag("--compare", options->look.compare, "show the path-traced truth beside the light maps (key K)");
  cmd->add_flag_callback(
      "--sharp-edges", [options] { options->look.smoothEdges = false; }, "do not smooth edges (key M)");
  cmd->add_flag("--panel", options->look.panel, "show the controls (key Tab)");
  const auto sky = std::make_shared<BakeOptions>();
  const auto environment = std::make_shared<std::string>();
  addSkyOptions(*cmd, *sky, *environment);
  cmd->add_option("--frames", options->frames, "end after that many frames; 0: when the window is closed")
      ->check(CLI::Range(0, 1'000'000'000))
      ->capture_default_str();
  cmd->add_option("--screenshot", options->screenshot, "save the last frame, overlay included, as a PNG");
  const auto record = cmd->add_option("--record", options->record, "write the walk to this file at the end (JSON)");
  cmd->add_option("--replay", options->replay, "walk a recorded path again; moving ends it")->excludes(record);
  cmd->add_option("--benchmark", options->benchmark,
                  "with --replay: draw the path as fast as it goes and write frame times to this file (JSON)");
  cmd->add_option("--fps", options->fps, "of the benchmark: frames a second of the path")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  cmd->add_flag("--watch", options->watch, "load the maps again whenever they have been replaced");
  cmd->callback([=, &action] {
    action = [=] {
      applySize(*size, options->render);
      applyScale(*scale, *options);
      finishSky(*sky, *environment);
      const PlayReport report = walkUntilEnded(*dlm, *options, *sky);
      logInfo(std::to_string(report.frames) + " frames in " + formatDuration(report.seconds));
    };
  });
}

}  // namespace lucarne
