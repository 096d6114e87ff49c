#include "player/gl_objects.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/error.h"

namespace lucarne {
namespace {

void clearErrors() {
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
}

void throwIfOutOfMemory(const std::string& what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) throw Error(ExitCode::outOfResource, "OpenGL has no memory for " + what);
  throw Error(ExitCode::failed, "OpenGL refused " + what + " (error " + std::to_string(error) + ")");
}

std::string firstLine(std::string log) {
  log.resize(std::min(log.find('\0'), log.size()));
  return log.substr(0, log.find('\n'));
}

GLuint compile(GLenum stage, const std::string& name, const std::string& source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0, length = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader, length, nullptr, log.data());
  glDeleteShader(shader);
  throw Error(ExitCode::failed, "the OpenGL driver cannot compile the shader " + name + ": " + firstLine(log));
}

}  // namespace

GlBuffer makeBuffer(std::span<const std::byte> bytes, GLbitfield flags) {
  static constexpr std::array<std::byte, 16> kNothing{};
  if (bytes.empty()) bytes = kNothing;
  clearErrors();
  GLuint name = 0;
  glCreateBuffers(1, &name);
  GlBuffer buffer(name);
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), flags);
  throwIfOutOfMemory("a buffer of " + std::to_string(bytes.size()) + " bytes");
  return buffer;
}

GlTexture makeTexture(const TextureShape& shape) {
  clearErrors();
  GLuint name = 0;
  glCreateTextures(shape.target, 1, &name);
  GlTexture texture(name);
  if (shape.target == GL_TEXTURE_2D_ARRAY) {
    glTextureStorage3D(name, shape.levels, shape.format, shape.width, shape.height, shape.layers);
  } else {
    glTextureStorage2D(name, shape.levels, shape.format, shape.width, shape.height);
  }
  throwIfOutOfMemory("a texture of " + std::to_string(shape.width) + " x " + std::to_string(shape.height) + " x " +
                     std::to_string(shape.layers) + " texels");
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

GlProgram makeProgram(const std::string& name, const std::string& vertexSource, const std::string& fragmentSource) {
  GlProgram program(glCreateProgram());
  const GLuint vertex = compile(GL_VERTEX_SHADER, name, vertexSource);
  glAttachShader(program.get(), vertex);
  glDeleteShader(vertex);  // lives on until the program lets go of it
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, name, fragmentSource);
  glAttachShader(program.get(), fragment);
  glDeleteShader(fragment);
  glLinkProgram(program.get());
  GLint ok = 0, length = 0;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return program;
  glGetProgramiv(program.get(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program.get(), length, nullptr, log.data());
  throw Error(ExitCode::failed, "the OpenGL driver cannot link the shader " + name + ": " + firstLine(log));
}

void checkComplete(const GlFramebuffer& framebuffer, std::string_view what) {
  if (glCheckNamedFramebufferStatus(framebuffer.get(), GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw Error(ExitCode::failed, "the OpenGL driver cannot draw to " + std::string(what));
}

GlFramebuffer makeFramebuffer(GLuint color, GLuint depth, std::string_view what) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  GlFramebuffer framebuffer(name);
  if (color != 0) glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color, 0);
  if (depth != 0) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth, 0);
  checkComplete(framebuffer, what);
  return framebuffer;
}

}  // namespace lucarne
