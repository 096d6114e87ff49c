// How long the GPU took for a frame, without waiting for it.
#pragma once

#include <array>
#include <optional>

#include "player/gl_objects.h"

namespace lucarne {

class GpuTimer {
 public:
  /// `believable`: false on software drivers, whose queries do not measure the work; nothing is asked then.
  explicit GpuTimer(bool believable);

  void begin();
  void end();
  /// Of the latest frame that is known.
  std::optional<double> seconds() const { return seconds_; }

 private:
  static constexpr std::size_t kFrames = 4;
  bool believable_;
  std::array<GlQuery, kFrames> queries_;
  std::array<bool, kFrames> pending_{};
  std::size_t current_ = 0;
  bool running_ = false;
  std::optional<double> seconds_;
};

}  // namespace lucarne
