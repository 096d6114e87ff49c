// A window with OpenGL 4.5, its keys and its mouse.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "player/gl_context.h"
#include "player/walk_camera.h"

struct GLFWwindow;

namespace lucarne {

enum class WalkKey { quit, singlepass, multipass, brighter, darker, autoExposure, help };

class Window {
 public:
  /// Error(failed) without a display (GLFW is not touched then) or without OpenGL 4.5.
  Window(int width, int height, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  struct Size {
    int width, height;
  };
  Size framebufferSize() const;  // pixels; 0 while minimised

  /// Handles the window's events.
  void poll();
  /// Keys pressed since the last call, in order.
  std::vector<WalkKey> takeKeys();
  /// Held keys and the mouse's way since the last call. The mouse turns the head while it is held by the window: click
  /// to hold it, Esc lets go.
  WalkInput takeWalk();
  bool closing() const;
  void close();
  void swap();

  const GlMessages& messages() const { return *messages_; }

 private:
  static void onKey(GLFWwindow* window, int key, int scancode, int action, int mods);
  static void onButton(GLFWwindow* window, int button, int action, int mods);
  bool held(int key) const;
  void holdMouse(bool hold);

  GLFWwindow* window_ = nullptr;
  std::unique_ptr<GlMessages> messages_;
  std::vector<WalkKey> keys_;
  bool mouseHeld_ = false, mouseKnown_ = false;
  double mouseX_ = 0, mouseY_ = 0;
};

}  // namespace lucarne
