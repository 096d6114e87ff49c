// The text over the picture.
#pragma once

#include <optional>

#include "player/render_options.h"

struct GLFWwindow;

namespace lucarne {

struct OverlayText {
  double frameSeconds = 0;           // smoothed
  std::optional<double> gpuSeconds;  // where the driver's timer can be believed
  RendererKind renderer = RendererKind::singlepass;
  RenderStats stats;
  double photons = 0;         // 0: not known
  int width = 0, height = 0;  // drawn pixels
  double exposureStops = 0;
  bool help = false;
};

class Overlay {
 public:
  explicit Overlay(GLFWwindow* window);  // needs its context to be current
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws into the current framebuffer.
  void draw(const OverlayText& text);
};

}  // namespace lucarne
