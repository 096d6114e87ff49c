#include "player/window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

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
  if (glfwInit() != GLFW_TRUE)
    throw Error(ExitCode::failed, "play opens a window, but the display cannot be opened (" + glfwReason() +
                                      "); use lucarne render for pictures");
}

void setHints() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // frames are drawn elsewhere and copied
}

}  // namespace

Window::Window(int width, int height, const std::string& title) : messages_(std::make_unique<GlMessages>()) {
  requireDisplay();
  setHints();
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
  glfwSetScrollCallback(window_, onScroll);
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

bool Window::isMinimised() const {
  const Size size = framebufferSize();
  return size.width < 1 || size.height < 1 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE;
}

void Window::poll(double waitSeconds) {
  if (waitSeconds > 0) {
    glfwWaitEventsTimeout(waitSeconds);
  } else {
    glfwPollEvents();
  }
}

void Window::setVsync(bool wait) { glfwSwapInterval(wait ? 1 : 0); }
std::vector<WalkKey> Window::takeKeys() { return std::exchange(keys_, {}); }
std::vector<KeyPress> Window::takePresses() { return std::exchange(presses_, {}); }
bool Window::closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::swap() { glfwSwapBuffers(window_); }
bool Window::held(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

WalkInput Window::takeWalk() {
  const auto either = [&](int a, int b) { return held(a) || held(b) ? 1. : 0.; };
  WalkInput input;
  input.forward = either(GLFW_KEY_W, GLFW_KEY_UP) - either(GLFW_KEY_S, GLFW_KEY_DOWN);
  input.sideways = either(GLFW_KEY_D, GLFW_KEY_RIGHT) - either(GLFW_KEY_A, GLFW_KEY_LEFT);
  input.upward = either(GLFW_KEY_E, GLFW_KEY_SPACE) - either(GLFW_KEY_Q, GLFW_KEY_Q);
  input.run = either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) > 0;
  input.crouch = either(GLFW_KEY_C, GLFW_KEY_LEFT_CONTROL) > 0;
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  if (mouseHeld_ && mouseKnown_) {
    input.turnX = (x - mouseX_) * kRadiansPerPixel;
    input.turnY = (y - mouseY_) * kRadiansPerPixel;
  }
  mouseKnown_ = true;
  mouseX_ = x;
  mouseY_ = y;
  const double now = glfwGetTime();
  gamepad_.add(input, keys_, now - lastTaken_);
  lastTaken_ = now;
  return input;
}

void Window::holdMouse(bool hold) {
  glfwSetInputMode(window_, GLFW_CURSOR, hold ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  mouseHeld_ = hold;
  mouseKnown_ = false;  // the cursor may have been moved by the change
}

void Window::onKey(GLFWwindow* window, int key, int, int action, int mods) {
  if (action != GLFW_PRESS) return;
  auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
  self.presses_.push_back({key, (mods & GLFW_MOD_SHIFT) != 0});
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
    case GLFW_KEY_F:
      self.keys_.push_back(WalkKey::fly);
      break;
    case GLFW_KEY_N:
      self.keys_.push_back(WalkKey::nextCamera);
      break;
    case GLFW_KEY_P:
      self.keys_.push_back(WalkKey::previousCamera);
      break;
    case GLFW_KEY_R:
      self.keys_.push_back(WalkKey::reload);
      break;
    case GLFW_KEY_HOME:
      self.keys_.push_back(WalkKey::startAgain);
      break;
    default:
      break;
  }
}

void Window::onScroll(GLFWwindow* window, double, double y) {
  if (y == 0) return;
  static_cast<Window*>(glfwGetWindowUserPointer(window))->keys_.push_back(y > 0 ? WalkKey::faster : WalkKey::slower);
}

void Window::onButton(GLFWwindow* window, int button, int action, int) {
  const bool forControls = ImGui::GetCurrentContext() != nullptr && ImGui::GetIO().WantCaptureMouse;
  if (forControls || button != GLFW_MOUSE_BUTTON_LEFT) return;
  if (action == GLFW_PRESS) static_cast<Window*>(glfwGetWindowUserPointer(window))->holdMouse(true);
}

Window::SharedContext::SharedContext(const Window& window) {
  setHints();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  hidden_ = glfwCreateWindow(16, 16, "", nullptr, window.handle());
  glfwDefaultWindowHints();
  if (hidden_ == nullptr) throw Error(ExitCode::failed, "no second OpenGL context: " + glfwReason());
}

Window::SharedContext::~SharedContext() { glfwDestroyWindow(hidden_); }

void Window::SharedContext::makeCurrent(GlMessages* sink) {
  glfwMakeContextCurrent(hidden_);
  listenToDriver(sink);
}

void Window::SharedContext::release() { glfwMakeContextCurrent(nullptr); }

}  // namespace lucarne
