// A window with OpenGL 4.5, its keys and its mouse.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "player/gamepad.h"
#include "player/gl_context.h"
#include "player/key_press.h"
#include "player/walk_input.h"
#include "player/walk_key.h"

struct GLFWwindow;

namespace lucarne {

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

  bool isMinimised() const;
  /// Handles the window's events; waits up to that long for one.
  void poll(double waitSeconds = 0);
  /// Frames wait for the display (as they do at first), or come as fast as they can.
  void setVsync(bool wait);
  /// Keys pressed since the last call, in order.
  std::vector<WalkKey> takeKeys();
  /// Every key pressed since the last call, those of takeKeys() too: however long a frame takes, none is missed.
  std::vector<KeyPress> takePresses();
  /// Held keys, the mouse's way since the last call, and the first gamepad. The mouse turns the head while it is held
  /// by the window: click to hold it, Esc lets go.
  WalkInput takeWalk();
  bool closing() const;
  void close();
  void swap();

  const GlMessages& messages() const { return *messages_; }

  /// A second context, for another thread, that shares all objects but vertex arrays, framebuffers and queries. Made
  /// and destroyed on the thread of the window.
  class SharedContext {
   public:
    explicit SharedContext(const Window& window);
    ~SharedContext();
    SharedContext(const SharedContext&) = delete;
    SharedContext& operator=(const SharedContext&) = delete;
    /// On the thread that calls; `sink` must outlive the context.
    void makeCurrent(GlMessages* sink);
    void release();

   private:
    GLFWwindow* hidden_ = nullptr;
  };

 private:
  static void onKey(GLFWwindow* window, int key, int scancode, int action, int mods);
  static void onButton(GLFWwindow* window, int button, int action, int mods);
  static void onScroll(GLFWwindow* window, double x, double y);
  bool held(int key) const;
  void holdMouse(bool hold);

  GLFWwindow* window_ = nullptr;
  std::unique_ptr<GlMessages> messages_;
  std::vector<WalkKey> keys_;
  std::vector<KeyPress> presses_;
  bool mouseHeld_ = false, mouseKnown_ = false;
  double mouseX_ = 0, mouseY_ = 0;
  double lastTaken_ = 0;  // seconds
  Gamepad gamepad_;
};

}  // namespace lucarne
