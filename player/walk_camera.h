// The walker: where it stands, where it looks, how keys move it. No window in here.
#pragma once

#include "tracer/scene/scene.h"

namespace lucarne {

/// What is held down, −1 … 1 an axis, and how far the mouse has turned the head since the last frame.
struct WalkInput {
  double forward = 0, sideways = 0, upward = 0;
  bool run = false;
  double turnX = 0, turnY = 0;  // radians, right and down
  bool moving() const { return forward != 0 || sideways != 0 || upward != 0 || turnX != 0 || turnY != 0; }
};

class WalkCamera {
 public:
  /// Starts at `start`, upright: a roll of the camera is lost. `speed`: local units a second.
  WalkCamera(const Camera& start, double speed);

  /// Forward is along the floor; looking up or down does not lift the walker.
  void move(const WalkInput& input, double seconds);
  Camera camera() const;

 private:
  Vec3d position_;
  double yaw_, pitch_;  // 0, 0 looks along −z
  double yfov_, speed_;
};

/// A walk in metres a second where the scene has a walkable size, and a share of its size where it has not; local units
/// a second.
double walkSpeed(const Scene& scene);

}  // namespace lucarne
