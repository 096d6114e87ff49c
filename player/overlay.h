// The text over the picture.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "player/look_panel.h"
#include "player/render_options.h"

struct GLFWwindow;

namespace lucarne {

struct OverlayText {
  double frameSeconds = 0;  // smoothed
  double lastFrameSeconds = 0;
  std::optional<double> gpuSeconds;  // where the driver's timer can be believed
  RendererKind renderer = RendererKind::singlepass;
  RenderStats stats;
  double photons = 0;         // 0: not known
  int width = 0, height = 0;  // drawn pixels
  double renderScale = 1;     // of the window's pixels, each way
  double ev100 = 0;           // of the picture shown
  bool help = false;
  std::string truth;                                 // LookTools::truthState()
  const std::optional<Inspection>* found = nullptr;  // shown where there is one
  std::string note;         // what happens just now: loading, an error; alone where nothing is drawn yet
};

class Overlay {
 public:
  /// Needs its context to be current. Without a window (null) `draw` is for pictures of the text's size.
  explicit Overlay(GLFWwindow* window);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws into the current framebuffer. Mouse and controls change `look`.
  void draw(const OverlayText& text, LookSettings& look);

 private:
  void newFrame(const OverlayText& text);
  void layOut(const OverlayText& text, LookSettings& look);
  void drawGraph() const;

  GLFWwindow* window_;
  std::array<float, 120> milliseconds_{};  // of the last frames, a ring
  std::size_t frame_ = 0;
};

}  // namespace lucarne
