#include "player/display_pass.h"

#include "player/read_back.h"
#include "player/shader_library.h"
#include "player/tonemap.h"

namespace lucarne {
namespace {

constexpr int kCoarseWidth = 64, kCoarseHeight = 36;

GlProgram displayProgram() {
  const std::string_view vertex[] = {"screen_vertex.glsl"}, fragment[] = {"display.glsl"};
  return makeProgram("display.glsl", assembleShader(vertex, {}), assembleShader(fragment, {}));
}

GlVertexArray emptyVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}

}  // namespace

DisplayPass::DisplayPass()
    : program_(displayProgram()), nothing_(emptyVertexArray()), coarse_(kCoarseWidth, kCoarseHeight, true) {}

float DisplayPass::meter(const FrameTarget& frame) const {
  glBlitNamedFramebuffer(frame.shading.get(), coarse_.shading.get(), 0, 0, frame.width, frame.height, 0, 0,
                         kCoarseWidth, kCoarseHeight, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  return autoExposure(readBack(coarse_));
}

void DisplayPass::show(const FrameTarget& frame, float exposure, int width, int height, GLuint framebuffer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);  // the shader encodes
  glUseProgram(program_.get());
  glProgramUniform1f(program_.get(), glGetUniformLocation(program_.get(), "exposure"), exposure);
  glBindVertexArray(nothing_.get());
  glBindTextureUnit(0, frame.color.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lucarne
