// The walkthrough in a window.
#pragma once

#include <filesystem>
#include <string>

#include "dlm/light_maps.h"
#include "player/render_options.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct PlayOptions {
  RenderOptions render;  // the window's first size, the first renderer, the light maps' format
  std::string camera;    // as chooseCamera()
  std::string title = "Lucarne";
  double renderScale = 1;            // drawn pixels per window pixel, each way, 0.1 … 1
  double photons = 0;                // of the bake, for the overlay; 0: not known
  int frames = 0;                    // > 0: ends after that many
  std::filesystem::path screenshot;  // not empty: the last frame with its overlay, as PNG
};

/// How the session went.
struct PlayReport {
  std::uint64_t frames = 0;
  double seconds = 0;  // of the frames, without loading
  RenderStats stats;   // of the last frame
};

/// Runs until the window is closed. Error(failed) without a display or OpenGL 4.5, Error(usage) for an unknown camera.
PlayReport play(const Scene& scene, const LightMaps& maps, const PlayOptions& options);

}  // namespace lucarne
