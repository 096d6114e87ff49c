// What the walker is told to do, from whatever device.
#pragma once

namespace lucarne {

/// What is held down, −1 … 1 an axis, and how far the head has been turned since the last time it was asked.
struct WalkInput {
  double forward = 0, sideways = 0;
  double upward = 0;  // flying: up and down; walking: a jump
  bool run = false, crouch = false;
  double turnX = 0, turnY = 0;  // radians, right and down
  bool moving() const { return forward != 0 || sideways != 0 || upward != 0 || turnX != 0 || turnY != 0; }
};

}  // namespace lucarne
