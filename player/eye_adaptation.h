// The automatic exposure: follows the picture as an eye does, slowly and by ratios.
#pragma once

#include "player/display_pass.h"

namespace lucarne {

class EyeAdaptation {
 public:
  /// Whether frame number `frame` is one of those that are metered, which takes time.
  static bool meters(std::uint64_t frame) { return frame % kFramesPerMetering == 0; }

  /// Once a frame, in their order; `seconds` since the one before. The first is exposed as it should be at once.
  void follow(const DisplayPass& display, const FrameTarget& frame, ViewScale scale, std::uint64_t number, double seconds) {
    if (meters(number)) meter(display.meter(frame, scale));
    pass(seconds);
  }
  /// The two halves of follow(), for those who meter no frames but every so many.
  void meter(float exposure) { metered_ = exposure; }
  void pass(double seconds);

  float exposure() const { return exposure_; }

 private:
  static constexpr int kFramesPerMetering = 8;
  bool first_ = true;
  float metered_ = 1, exposure_ = 1;
};

}  // namespace lucarne
