#include "player/gamepad.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace lucarne::gamepad_test {
namespace {

/// A pad at rest: sticks near the middle, triggers let go.
GLFWgamepadstate atRest() {
  GLFWgamepadstate pad{};
  pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 0.08f;
  pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -0.05f;
  pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = -0.1f;
  pad.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] = pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = -1;
  return pad;
}

struct Taken {
  WalkInput input;
  std::vector<WalkKey> keys;
};

Taken taken(Gamepad& gamepad, const GLFWgamepadstate& pad, double seconds = 0.02) {
  Taken t;
  gamepad.take(pad, t.input, t.keys, seconds);
  return t;
}

TEST(Stick, RestsInTheDeadZoneAndIsFinerNearIt) {
  for (const double axis : {0., 0.1, -0.14}) EXPECT_EQ(stickShare(axis), 0);
  EXPECT_DOUBLE_EQ(stickShare(1), 1);
  EXPECT_DOUBLE_EQ(stickShare(-1.2), -1);  // beyond what a pad should send
  double before = 0;
  for (double axis = 0.2; axis <= 1; axis += 0.1) {
    EXPECT_GT(stickShare(axis), before);
    EXPECT_LE(stickShare(axis), axis);
    EXPECT_EQ(stickShare(-axis), -stickShare(axis));
    before = stickShare(axis);
  }
  EXPECT_LT(stickShare(0.575), 0.3);  // the middle of what is left
}

TEST(GamepadMapping, APadAtRestDoesNothing) {
  Gamepad gamepad;
  const Taken t = taken(gamepad, atRest());
  EXPECT_FALSE(t.input.moving());
  EXPECT_FALSE(t.input.run || t.input.crouch);
  EXPECT_TRUE(t.keys.empty());
}

TEST(GamepadMapping, LeftStickWalksAndRightStickLooks) {
  Gamepad gamepad;
  GLFWgamepadstate pad = atRest();
  pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -1;  // away from the player
  pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X] = 1;
  pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = 1;
  pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y] = -1;
  const Taken t = taken(gamepad, pad);
  EXPECT_EQ(t.input.forward, 1);
  EXPECT_EQ(t.input.sideways, 1);
  EXPECT_GT(t.input.turnX, 0);
  EXPECT_EQ(t.input.turnY, -t.input.turnX);
}

TEST(GamepadMapping, TheHeadTurnsByTimeButNotThroughALongPause) {
  Gamepad gamepad;
  GLFWgamepadstate pad = atRest();
  pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X] = 1;
  const double a = taken(gamepad, pad, 0.01).input.turnX, b = taken(gamepad, pad, 0.02).input.turnX;
  EXPECT_NEAR(b, 2 * a, 1e-12);
  EXPECT_LT(taken(gamepad, pad, 60).input.turnX, 0.5);
}

TEST(GamepadMapping, KeysAndPadTogetherAreNoFasterThanOne) {
  Gamepad gamepad;
  GLFWgamepadstate pad = atRest();
  pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y] = -1;
  Taken t;
  t.input.forward = 1;
  gamepad.take(pad, t.input, t.keys, 0.02);
  EXPECT_EQ(t.input.forward, 1);
}

TEST(GamepadMapping, HeldButtonsActWhileHeld) {
  Gamepad gamepad;
  GLFWgamepadstate pad = atRest();
  pad.buttons[GLFW_GAMEPAD_BUTTON_A] = pad.buttons[GLFW_GAMEPAD_BUTTON_B] = GLFW_PRESS;
  pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] = 1;
  for (int i = 0; i < 3; ++i) {
    const Taken t = taken(gamepad, pad);
    EXPECT_EQ(t.input.upward, 1);
    EXPECT_TRUE(t.input.crouch);
    EXPECT_TRUE(t.input.run);
    EXPECT_TRUE(t.keys.empty());
  }
  pad.buttons[GLFW_GAMEPAD_BUTTON_A] = GLFW_RELEASE;
  pad.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] = GLFW_PRESS;
  EXPECT_EQ(taken(gamepad, pad).input.upward, -1);
}

TEST(GamepadMapping, APressIsOneKeyHoweverLongItLasts) {
  const std::pair<int, WalkKey> buttons[] = {
      {GLFW_GAMEPAD_BUTTON_Y, WalkKey::fly},           {GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, WalkKey::nextCamera},
      {GLFW_GAMEPAD_BUTTON_DPAD_LEFT, WalkKey::previousCamera}, {GLFW_GAMEPAD_BUTTON_DPAD_UP, WalkKey::brighter},
      {GLFW_GAMEPAD_BUTTON_DPAD_DOWN, WalkKey::darker}, {GLFW_GAMEPAD_BUTTON_BACK, WalkKey::help},
      {GLFW_GAMEPAD_BUTTON_START, WalkKey::startAgain}};
  Gamepad gamepad;
  for (const auto& [button, key] : buttons) {
    GLFWgamepadstate pad = atRest();
    for (int press = 0; press < 2; ++press) {
      pad.buttons[button] = GLFW_PRESS;
      EXPECT_EQ(taken(gamepad, pad).keys, std::vector{key});
      EXPECT_TRUE(taken(gamepad, pad).keys.empty());
      pad.buttons[button] = GLFW_RELEASE;
      EXPECT_TRUE(taken(gamepad, pad).keys.empty());
    }
  }
}

}  // namespace
}  // namespace lucarne::gamepad_test
