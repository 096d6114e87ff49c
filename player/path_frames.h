// The pictures of a recorded walk, without a display: drawn, exposed and shown by what draws the window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "player/benchmark.h"
#include "player/map_source.h"
#include "player/walk_path.h"

namespace lucarne {

struct PathFramesOptions {
  RenderOptions render;
  double fps = 30;       // of the path
  bool overlay = false;  // the window's text over each picture
  double photons = 0;    // for the overlay; 0: not known
};

struct PathFramesSink {
  std::function<bool(std::size_t frame)> isWanted;
  /// 3 bytes a pixel, top row first.
  std::function<void(std::size_t frame, const std::vector<std::uint8_t>& rgb)> take;
};

/// Calls the sink for each frame in order. A frame is the same whichever of those before it are wanted. Frame times
/// (drawing and reading back) are of the frames wanted, but for the first. Errors as renderImage().
Benchmark drawPath(const Scene& scene, const MapSource& maps, const WalkPath& path, const PathFramesOptions& options,
                   const PathFramesSink& sink);

}  // namespace lucarne
