#include "player/gamepad.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

constexpr double kDeadZone = 0.15, kTurnsPerSecond = 2.5;  // radians
constexpr double kLongestTurn = 0.1;                       // seconds

bool firstGamepad(GLFWgamepadstate& state) {
  for (int i = GLFW_JOYSTICK_1; i <= GLFW_JOYSTICK_LAST; ++i) {
    if (glfwJoystickIsGamepad(i) == GLFW_TRUE && glfwGetGamepadState(i, &state) == GLFW_TRUE) return true;
  }
  return false;
}

struct ButtonKey {
  int button;
  WalkKey key;
};
constexpr ButtonKey kKeys[] = {{GLFW_GAMEPAD_BUTTON_Y, WalkKey::fly},
                               {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, WalkKey::nextCamera},
                               {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, WalkKey::previousCamera},
                               {GLFW_GAMEPAD_BUTTON_DPAD_UP, WalkKey::brighter},
                               {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, WalkKey::darker},
                               {GLFW_GAMEPAD_BUTTON_BACK, WalkKey::help},
                               {GLFW_GAMEPAD_BUTTON_START, WalkKey::startAgain}};

}  // namespace

double stickShare(double axis) {
  const double beyond = std::max(0.0, std::min(std::abs(axis), 1.0) - kDeadZone) / (1 - kDeadZone);
  return std::copysign(beyond * beyond, axis);
}

void Gamepad::add(WalkInput& input, std::vector<WalkKey>& keys, double seconds) {
  GLFWgamepadstate pad;
  if (firstGamepad(pad)) take(pad, input, keys, seconds);
}

void Gamepad::take(const GLFWgamepadstate& pad, WalkInput& input, std::vector<WalkKey>& keys, double seconds) {
  const auto stick = [&](int axis) { return stickShare(static_cast<double>(pad.axes[axis])); };
  const auto pressed = [&](int button) { return pad.buttons[button] == GLFW_PRESS; };
  const auto add = [](double& to, double value) { to = std::clamp(to + value, -1.0, 1.0); };
  const double turn = kTurnsPerSecond * std::clamp(seconds, 0.0, kLongestTurn);
  add(input.forward, -stick(GLFW_GAMEPAD_AXIS_LEFT_Y));
  add(input.sideways, stick(GLFW_GAMEPAD_AXIS_LEFT_X));
  add(input.upward, (pressed(GLFW_GAMEPAD_BUTTON_A) ? 1 : 0) - (pressed(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER) ? 1 : 0));
  input.turnX += stick(GLFW_GAMEPAD_AXIS_RIGHT_X) * turn;
  input.turnY += stick(GLFW_GAMEPAD_AXIS_RIGHT_Y) * turn;
  input.run = input.run || pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] > 0;
  input.crouch = input.crouch || pressed(GLFW_GAMEPAD_BUTTON_B);
  for (const ButtonKey& k : kKeys) {
    const bool now = pressed(k.button);
    bool& before = held_[static_cast<std::size_t>(k.button)];
    if (now && !before) keys.push_back(k.key);
    before = now;
  }
}

}  // namespace lucarne
