// From the frame's radiance to the window: how bright it is, and the copy with exposure, tone curve and sRGB.
#pragma once

#include "player/frame_target.h"

namespace lucarne {

class DisplayPass {
 public:
  DisplayPass();  // needs a current context

  /// autoExposure() of a coarse copy of the frame; waits for the driver.
  float meter(const FrameTarget& frame) const;
  /// Stretches the frame over a framebuffer (0: the default one), which is width × height pixels.
  void show(const FrameTarget& frame, float exposure, int width, int height, GLuint framebuffer = 0) const;

 private:
  GlProgram program_;
  GlVertexArray nothing_;
  FrameTarget coarse_;
};

}  // namespace lucarne
