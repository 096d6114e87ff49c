// The text over the picture.
#pragma once

#include <optional>
#include <string>

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
  std::string note;         // what happens just now: loading, an error; alone where nothing is drawn yet
};

class Overlay {
 public:
  /// Needs its context to be current. Without a window (null) `draw` is for pictures of the text's size.
  explicit Overlay(GLFWwindow* window);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws into the current framebuffer.
  void draw(const OverlayText& text);

 private:
  void newFrame(const OverlayText& text);
  void layOut(const OverlayText& text);

  GLFWwindow* window_;
};

}  // namespace lucarne
