#include "player/display_pass.h"

#include "base/heat_colour.h"
#include "player/read_back.h"
#include "player/shader_library.h"
#include "player/tonemap.h"

namespace lucarne {
namespace {

constexpr int kCoarseWidth = 64, kCoarseHeight = 36, kHeatSteps = 8;

/// The colours of heat_colour.h at its steps, as GLSL.
std::string heatColours() {
  std::string text = "HEAT_COLOURS vec3[](";
  for (int i = 0; i <= kHeatSteps; ++i) {
    const auto c = heatColour(static_cast<double>(i) / kHeatSteps);
    text += std::string(i == 0 ? "" : ", ") + "vec3(" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " +
            std::to_string(c[2]) + ") / 255.0";
  }
  return text + ")";
}

GlProgram screenProgram(std::string_view name, const std::vector<std::string>& defines = {}) {
  const std::string_view vertex[] = {"screen_vertex.glsl"}, fragment[] = {name};
  return makeProgram(std::string(name), assembleShader(vertex, {}), assembleShader(fragment, defines));
}

GlVertexArray emptyVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}

}  // namespace

DisplayPass::DisplayPass()
    : display_(screenProgram("display.glsl", {heatColours()})),
      smooth_(screenProgram("smooth_edges.glsl")),
      nothing_(emptyVertexArray()),
      coarse_(kCoarseWidth, kCoarseHeight, true) {}

float DisplayPass::meter(const FrameTarget& frame, ViewScale scale) const {
  glBlitNamedFramebuffer(frame.shading.get(), coarse_.shading.get(), 0, 0, frame.width, frame.height, 0, 0,
                         kCoarseWidth, kCoarseHeight, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  const ImageRgb image = readBack(coarse_);
  return scale == ViewScale::number ? 1 / heatTop(image) : autoExposure(image);
}

void DisplayPass::drawTo(GLuint framebuffer, int width, int height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DisplayPass::show(const FrameTarget& frame, const DisplayStyle& style, int width, int height, GLuint framebuffer) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);  // the shader encodes
  glBindVertexArray(nothing_.get());
  glUseProgram(display_.get());
  const auto at = [&](const char* name) { return glGetUniformLocation(display_.get(), name); };
  glUniform1f(at("exposure"), style.exposure);
  glUniform2i(at("mode"), static_cast<GLint>(style.scale), static_cast<GLint>(style.curve));
  const bool divided = style.other != 0;
  glUniform2f(at("divider"), divided ? style.divider : 2.f, 1.f / static_cast<float>(width));
  glBindTextureUnit(0, frame.color.get());
  glBindTextureUnit(1, divided ? style.other : frame.color.get());
  if (!style.smoothEdges) {
    drawTo(framebuffer, width, height);
    return;
  }
  if (finishedWidth_ != frame.width || finishedHeight_ != frame.height) {
    finished_ = makeTexture({GL_TEXTURE_2D, GL_RGBA8, 1, frame.width, frame.height, 1});
    finishedTarget_ = makeFramebuffer(finished_.get(), 0, "an 8-bit image");
    finishedWidth_ = frame.width;
    finishedHeight_ = frame.height;
  }
  drawTo(finishedTarget_.get(), frame.width, frame.height);
  glUseProgram(smooth_.get());
  glBindTextureUnit(0, finished_.get());
  drawTo(framebuffer, width, height);
}

}  // namespace lucarne
