#include "player/sky_pass.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "player/map_upload.h"
#include "player/shader_library.h"

namespace lucarne {
namespace {

GlProgram skyProgram(float outputScale) {
  const std::string_view vertex[] = {"screen_vertex.glsl"}, fragment[] = {"camera.glsl", "sky_pass.glsl"};
  GlProgram program = makeProgram("sky_pass.glsl", assembleShader(vertex, {}), assembleShader(fragment, {}));
  glProgramUniform1f(program.get(), glGetUniformLocation(program.get(), "outputScale"), outputScale);
  return program;
}

GlVertexArray emptyVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}

GlTexture upload(const ImageRgb& image) {
  if (image.width > textureLimits().size || image.height > textureLimits().size)
    throw Error(ExitCode::outOfResource, "the environment map is larger than OpenGL allows");
  std::vector<Rgb> pixels = image.pixels;
  for (Rgb& p : pixels) {
    for (int i = 0; i < 3; ++i) p[i] = std::isfinite(p[i]) ? std::max(p[i], 0.f) : 0.f;
  }
  GlTexture texture = makeTexture({GL_TEXTURE_2D, GL_RGB32F, 1, image.width, image.height, 1});
  glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, GL_REPEAT);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.get(), 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT, pixels.data());
  return texture;
}

}  // namespace

SkyPass::SkyPass(const ImageRgb& image, float outputScale)
    : program_(skyProgram(outputScale)),
      nothing_(emptyVertexArray()),
      image_(upload(image)),
      bytes_(image.pixels.size() * sizeof(Rgb)) {}

void SkyPass::draw(const FrameTarget& target) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target.shading.get());
  glUseProgram(program_.get());
  glBindVertexArray(nothing_.get());
  glBindTextureUnit(0, image_.get());
  glDepthFunc(GL_EQUAL);  // the triangle lies at the far plane
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lucarne
