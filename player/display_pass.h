// From the frame's values to the window: how bright it is, and the copy with exposure, tone curve and sRGB.
#pragma once

#include "player/display_image.h"
#include "player/frame_target.h"

namespace lucarne {

struct DisplayStyle {
  ViewScale scale = ViewScale::light;
  ToneCurve curve = ToneCurve::filmic;
  float exposure = 1;        // of numbers: one over what the palest colour stands for
  bool smoothEdges = false;  // a filter over the finished picture
  GLuint other = 0;          // a picture of light in the frame's units, shown right of the divider; 0: none
  float divider = 1;         // 0 … 1 of the width
};

class DisplayPass {
 public:
  DisplayPass();  // needs a current context

  /// autoExposure() of a coarse copy of the frame, or one over heatTop(); waits for the driver.
  float meter(const FrameTarget& frame, ViewScale scale) const;
  /// Stretches the frame over the default framebuffer, or another, which is width × height pixels.
  void show(const FrameTarget& frame, const DisplayStyle& style, int width, int height, GLuint framebuffer = 0);

 private:
  void drawTo(GLuint framebuffer, int width, int height) const;

  GlProgram display_, smooth_;
  GlVertexArray nothing_;
  FrameTarget coarse_;
  GlTexture finished_;  // 8 bits, of the frame's size; made at the first use
  GlFramebuffer finishedTarget_;
  int finishedWidth_ = 0, finishedHeight_ = 0;
};

}  // namespace lucarne
