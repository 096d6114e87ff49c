// An OpenGL 4.5 core context without a window, and the driver's own messages.
//
// EGL's device platform is asked first, hardware before software, then Mesa's surfaceless platform; GLFW needs a
// display even for a hidden window. The context is current on the thread that made it until it is destroyed; it has no
// default framebuffer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace lucarne {

/// Counts what the driver complains of; notifications and performance hints are left out.
struct GlMessages {
  std::uint64_t errors = 0;
  std::string first;  // text of the first error
};

class HeadlessGl {
 public:
  /// Error(failed) when there is no OpenGL at all, or only an older one.
  HeadlessGl();
  ~HeadlessGl();
  HeadlessGl(const HeadlessGl&) = delete;
  HeadlessGl& operator=(const HeadlessGl&) = delete;

  const GlMessages& messages() const { return *messages_; }

 private:
  void* display_ = nullptr;  // EGLDisplay and EGLContext, so that users of this header need no EGL
  void* context_ = nullptr;
  std::unique_ptr<GlMessages> messages_;
};

/// Sends the driver's messages to `sink`, which must outlive the context. Needs a current context.
void listenToDriver(GlMessages* sink);

/// GL_RENDERER of the current context.
std::string driverName();
/// True for drivers that compute on the processor; their timer queries do not measure the work.
bool isSoftwareDriver(const std::string& name);

/// Error(failed) naming `what` if the driver has complained.
void throwOnComplaint(const GlMessages& messages, const std::string& what);

}  // namespace lucarne
