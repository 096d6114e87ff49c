// How fast frames came, as numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "player/render_options.h"

namespace lucarne {

/// Seconds. A percentile is one of the values: the smallest that so many of them do not exceed.
struct Spread {
  double mean = 0, p50 = 0, p90 = 0, p99 = 0, max = 0;
};
/// Zeros of no values.
Spread spreadOf(std::vector<double> values);

struct Benchmark {
  std::vector<double> frameSeconds;  // from one picture shown to the next
  std::vector<double> gpuSeconds;    // of the drawing; empty where the driver's timer does not measure it
  double pathFps = 0;                // frames a second of the path: the same pictures on every machine
  int width = 0, height = 0;
  RenderOptions options;
  RenderStats stats;  // of the last frame
  double loadSeconds = 0;
  double shownSeconds = 0;              // from the start to the first picture; 0: not of a window
  std::vector<double> loadingSeconds;   // of the window's frames until then, that picture's included
  std::uint64_t glBytes = 0;  // textures, and what frames are drawn into
};

/// JSON, times in milliseconds; with the process's peak of memory.
std::string textOf(const Benchmark& benchmark);

}  // namespace lucarne
