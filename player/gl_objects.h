// OpenGL names with owners: each type deletes its object in its destructor; all need a current context for their whole
// life.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace lucarne {

/// Moves, does not copy; 0 is the empty state. `Delete` is a functor type over the name.
template <class Delete>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) Delete()(name_);
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct DeleteBuffer {
  void operator()(GLuint n) const { glDeleteBuffers(1, &n); }
};
struct DeleteTexture {
  void operator()(GLuint n) const { glDeleteTextures(1, &n); }
};
struct DeleteFramebuffer {
  void operator()(GLuint n) const { glDeleteFramebuffers(1, &n); }
};
struct DeleteVertexArray {
  void operator()(GLuint n) const { glDeleteVertexArrays(1, &n); }
};
struct DeleteQuery {
  void operator()(GLuint n) const { glDeleteQueries(1, &n); }
};
struct DeleteProgram {
  void operator()(GLuint n) const { glDeleteProgram(n); }
};

using GlBuffer = GlName<DeleteBuffer>;
using GlTexture = GlName<DeleteTexture>;
using GlFramebuffer = GlName<DeleteFramebuffer>;
using GlVertexArray = GlName<DeleteVertexArray>;
using GlQuery = GlName<DeleteQuery>;
using GlProgram = GlName<DeleteProgram>;

/// Immutable buffer with these contents (at least 16 bytes, so that an empty list can be bound). Error(outOfResource)
/// when the driver has no memory for it.
GlBuffer makeBuffer(std::span<const std::byte> bytes, GLbitfield flags = 0);
template <class T>
GlBuffer makeBuffer(std::span<const T> values) {
  return makeBuffer(std::as_bytes(values));
}

struct TextureShape {
  GLenum target = GL_TEXTURE_2D, format = GL_RGBA32F;
  int levels = 1, width = 1, height = 1, layers = 1;
};
/// Immutable storage, clamped to the edge, linear without mipmaps. Error(outOfResource) when there is no memory for it.
GlTexture makeTexture(const TextureShape& shape);

/// Compiles and links. A failure is our own fault or the driver's: Error(failed) with the first line of its log.
GlProgram makeProgram(const std::string& name, const std::string& vertexSource, const std::string& fragmentSource);

/// Throws Error(failed) naming `what` when the framebuffer is not complete.
void checkComplete(const GlFramebuffer& framebuffer, std::string_view what);

/// A framebuffer of these attachments (0: none).
GlFramebuffer makeFramebuffer(GLuint color, GLuint depth, std::string_view what);

}  // namespace lucarne
