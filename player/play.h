// The walkthrough in a window.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/image_file.h"
#include "dlm/light_maps.h"
#include "player/benchmark.h"
#include "player/look_settings.h"
#include "player/render_options.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct PlayOptions {
  RenderOptions render;  // the window's first size, the first renderer, the light maps' format
  std::string camera;    // as chooseCamera()
  bool fly = false;      // starts flying, exactly at the camera; else on the floor near it, where there is any
  std::string title = "Lucarne";
  double renderScale = 0;  // drawn pixels per window pixel, each way, 0.1 … 1; 0: as many as are fast enough
  LookSettings look;       // at the start; its view and lobe count, those of `render` do not
  ImageRgb sky;            // behind the scene and for the truth: equirectangular, cd/m²; may be empty
  // Asked once the first maps are loaded: a line to be told, or none.
  std::function<std::string(const Scene&, const LightMaps&)> remark;
  int frames = 0;          // > 0: ends after that many
  std::filesystem::path screenshot;  // not empty: the last frame with its overlay, as PNG
  std::filesystem::path record;      // not empty: the walk is written there at the end (walk_path.h)
  std::filesystem::path replay;      // not empty: a recorded walk leads the camera, until a key moves it
  std::filesystem::path benchmark;   // not empty: replays without waiting for the display, reports there, and ends
  double fps = 30;                   // of the benchmark: frames a second of the path
  bool watch = false;                // loads the maps again when they have been replaced
  std::function<bool()> ended;       // asked once a frame: true ends the session as closing the window does
};

/// How the session went.
struct PlayReport {
  std::uint64_t frames = 0;
  double seconds = 0;  // of the frames, without loading
  RenderStats stats;   // of the last frame
};

/// Runs until the window is closed. The maps are loaded while the window is there already, and again with the key R;
/// maps that cannot be loaded again leave the old ones shown. The recording is written however the session ends, by an
/// error too. Error(failed) without a display or OpenGL 4.5, Error(usage) for an unknown camera, those of readDlm() and
/// readWalkPath().
PlayReport play(const std::filesystem::path& dlm, const PlayOptions& options);

}  // namespace lucarne
