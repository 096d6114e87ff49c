// Pictures of a .dlm without a window.
#pragma once

#include <filesystem>
#include <string>

#include "app/bake_options.h"
#include "player/display_image.h"
#include "player/render_options.h"

namespace lucarne {

struct RenderJob {
  std::filesystem::path dlm, output;  // .exr: linear cd/m², no exposure; .png: auto exposure, tone map, sRGB
  // The sky, which light maps do not keep: behind the scene, and of path-traced pictures their light. Of those also the
  // paths a pixel; `dlm` may be a scene then.
  std::uint32_t samples = 64;
  BakeOptions sky;
  std::string camera;  // name or index; empty: the first, or one that sees the scene
  RenderOptions options;
  DisplayOptions display;  // of .png
  bool overlay = false;    // of .png: the text that play shows, over the picture
};

struct RenderReport {
  RenderStats stats;
  std::string scale;      // DisplayedImage::scale of .png
  std::string otherwise;  // shownOtherwise()
};

/// Renders and writes the picture. UsageError for an unknown camera or ending, or an overlay where there is none to show.
RenderReport render(const RenderJob& job);

}  // namespace lucarne
