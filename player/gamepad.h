// The first gamepad that GLFW knows: left stick walks, right stick looks.
#pragma once

#include <array>
#include <vector>

#include "player/walk_input.h"
#include "player/walk_key.h"

struct GLFWgamepadstate;

namespace lucarne {

/// A stick's place without the middle, where sticks do not rest exactly, and finer near it; −1 … 1.
double stickShare(double axis);

class Gamepad {
 public:
  /// Adds what is held to `input` and what has been pressed since to `keys`; `seconds` since the last call. Nothing
  /// where there is no gamepad.
  void add(WalkInput& input, std::vector<WalkKey>& keys, double seconds);
  /// The same of a gamepad in this state.
  void take(const GLFWgamepadstate& pad, WalkInput& input, std::vector<WalkKey>& keys, double seconds);

 private:
  std::array<bool, 16> held_{};
};

}  // namespace lucarne
