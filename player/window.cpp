#include "player/window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <utility>

#include "base/error.h"

namespace lucarne {
namespace {

constexpr double kRadiansPerPixel = 0.0025;

std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason given";
}

/// The GLFW of Debian 12 speaks X11 only, and its start fails without a display even when no window is asked for.
void requireDisplay() {
  const char* display = std::getenv("DISPLAY");
  if (display == nullptr || *display == '\0') {
    throw Error(ExitCode::failed,
                "play opens a window, but there is no display (DISPLAY is not set); use lucarne render for pictures");
  }
  if (glfwInit() != GLFW_TRUE) throw Error(ExitCode::failed, "the display cannot be opened: " + glfwReason());
}

}  // namespace

Window::Window(int width, int height, const std::string& title) : messages_(std::make_unique<GlMessages>()) {
  requireDisplay();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // frames are drawn elsewhere and copied
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = glfwReason();
    glfwTerminate();
    throw Error(ExitCode::failed, "no window with OpenGL 4.5: " + reason);
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, onKey);
  glfwSetMouseButtonCallback(window_, onButton);
  listenToDriver(messages_.get());
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

Window::Size Window::framebufferSize() const {
  Size size{};
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

void Window::poll() { glfwPollEvents(); }
std::vector<WalkKey> Window::takeKeys() { return std::exchange(keys_, {}); }
bool Window::closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::swap() { glfwSwapBuffers(window_); }
bool Window::held(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

WalkInput Window::takeWalk() {
  const auto axis = [&](int plus, int minus) { return (held(plus) ? 1. : 0.) - (held(minus) ? 1. : 0.); };
  WalkInput input{axis(GLFW_KEY_W, GLFW_KEY_S), axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                  held(GLFW_KEY_LEFT_SHIFT) || held(GLFW_KEY_RIGHT_SHIFT)};
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  if (mouseHeld_ && mouseKnown_) {
    input.turnX = (x - mouseX_) * kRadiansPerPixel;
    input.turnY = (y - mouseY_) * kRadiansPerPixel;
  }
  mouseKnown_ = true;
  mouseX_ = x;
  mouseY_ = y;
  return input;
}

void Window::holdMouse(bool hold) {
  glfwSetInputMode(window_, GLFW_CURSOR, hold ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  mouseHeld_ = hold;
  mouseKnown_ = false;  // the cursor may have been moved by the change
}

void Window::onKey(GLFWwindow* window, int key, int, int action, int) {
  if (action != GLFW_PRESS) return;
  auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (self.mouseHeld_) {
        self.holdMouse(false);
      } else {
        self.keys_.push_back(WalkKey::quit);
      }
      break;
    case GLFW_KEY_1:
      self.keys_.push_back(WalkKey::singlepass);
      break;
    case GLFW_KEY_2:
      self.keys_.push_back(WalkKey::multipass);
      break;
    case GLFW_KEY_EQUAL:
    case GLFW_KEY_KP_ADD:
      self.keys_.push_back(WalkKey::brighter);
      break;
    case GLFW_KEY_MINUS:
    case GLFW_KEY_KP_SUBTRACT:
      self.keys_.push_back(WalkKey::darker);
      break;
    case GLFW_KEY_0:
      self.keys_.push_back(WalkKey::autoExposure);
      break;
    case GLFW_KEY_F1:
    case GLFW_KEY_H:
      self.keys_.push_back(WalkKey::help);
      break;
    default:
      break;
  }
}

void Window::onButton(GLFWwindow* window, int, int action, int) {
  if (action == GLFW_PRESS) static_cast<Window*>(glfwGetWindowUserPointer(window))->holdMouse(true);
}

}  // namespace lucarne
