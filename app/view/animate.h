// A recorded walk as pictures, one a frame.
#pragma once

#include <filesystem>
#include <optional>

#include "player/benchmark.h"

namespace lucarne {

struct AnimationJob {
  std::filesystem::path dlm, replay, output;  // output: a folder, made where it is missing
  std::filesystem::path benchmark;            // not empty: frame times go there; `output` may be empty then
  RenderOptions options;
  double fps = 30;
  bool overlay = false;
};

struct AnimationReport {
  std::size_t frames = 0, drawn = 0;  // of the path; those that were not there yet
  std::filesystem::path video;        // empty: no ffmpeg here
  RenderStats stats;
};

/// Writes frame_00000.png, frame_00001.png … as the window would show them, and walk.mp4 where there is ffmpeg. Every
/// file is whole or not there. Frames that are there already from the same command are kept: an interrupted one is
/// taken up again. UsageError where the folder holds frames of something else.
AnimationReport animate(const AnimationJob& job);

}  // namespace lucarne
