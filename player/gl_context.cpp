#include "player/gl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstring>
#include <vector>

#include "base/error.h"

namespace lucarne {
namespace {

struct Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  explicit operator bool() const { return context != EGL_NO_CONTEXT; }
};

constexpr std::array<EGLint, 7> kCore45 = {
    EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};

bool hasWord(const char* words, const char* word) { return words != nullptr && std::strstr(words, word) != nullptr; }

/// Current context on `display`, or none.
Context contextOn(EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) != EGL_TRUE) return {};
  const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE && eglChooseConfig(display, wanted, &config, 1, &count) == EGL_TRUE) {
    const EGLContext context = eglCreateContext(display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, kCore45.data());
    if (context != EGL_NO_CONTEXT) {
      if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) return {display, context};
      eglDestroyContext(display, context);
    }
  }
  eglTerminate(display);
  return {};
}

Context contextOnDevices(const char* clientExtensions) {
  if (!hasWord(clientExtensions, "EGL_EXT_platform_device")) return {};
  if (!hasWord(clientExtensions, "EGL_EXT_device_enumeration") && !hasWord(clientExtensions, "EGL_EXT_device_base"))
    return {};
  std::array<EGLDeviceEXT, 32> devices{};
  EGLint count = 0;
  if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) return {};
  for (const bool software : {false, true}) {
    for (EGLint i = 0; i < count; ++i) {
      const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      if (hasWord(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software") != software) continue;
      if (const Context made = contextOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr)))
        return made;
    }
  }
  return {};
}

Context anyContext() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (const Context made = contextOnDevices(extensions)) return made;
  if (!hasWord(extensions, "EGL_MESA_platform_surfaceless")) return {};
  return contextOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
}

void GLAPIENTRY onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                          const void* user) {
  if (type != GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
  auto* sink = static_cast<GlMessages*>(const_cast<void*>(user));
  if (sink->errors++ == 0) sink->first.assign(text, length < 0 ? std::strlen(text) : static_cast<std::size_t>(length));
}

}  // namespace

HeadlessGl::HeadlessGl() : messages_(std::make_unique<GlMessages>()) {
  const Context made = anyContext();
  if (!made) {
    throw Error(ExitCode::failed,
                "no OpenGL 4.5 without a display here; install a driver for EGL (Debian: libgl1-mesa-dri)");
  }
  display_ = made.display;
  context_ = made.context;
  listenToDriver(messages_.get());
}

HeadlessGl::~HeadlessGl() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

void listenToDriver(GlMessages* sink) {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onMessage, sink);
}

std::string driverName() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr ? name : "unknown";
}

bool isSoftwareDriver(const std::string& name) {
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos ||
         name.find("swrast") != std::string::npos;
}

void throwOnComplaint(const GlMessages& messages, const std::string& what) {
  if (messages.errors == 0) return;
  throw Error(ExitCode::failed, "OpenGL failed while " + what + ": " + messages.first);
}

}  // namespace lucarne
