#include "player/frame_target.h"

namespace lucarne {
namespace {

GlTexture image(int width, int height, GLenum format, GLint filter) {
  GlTexture texture = makeTexture({GL_TEXTURE_2D, format, 1, width, height, 1});
  glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, filter);
  glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, filter);
  return texture;
}

}  // namespace

FrameTarget::FrameTarget(int width_, int height_, bool exact)
    : width(width_),
      height(height_),
      color(image(width, height, exact ? GL_RGBA32F : GL_RGBA16F, GL_LINEAR)),
      depth(image(width, height, GL_DEPTH_COMPONENT32F, GL_NEAREST)),
      owner(image(width, height, GL_R32UI, GL_NEAREST)),
      lobe(image(width, height, GL_RGBA32F, GL_NEAREST)),
      prepass(makeFramebuffer(owner.get(), depth.get(), "a 32-bit integer image")),
      sums(makeFramebuffer(lobe.get(), depth.get(), "a 32-bit float image")),
      shading(makeFramebuffer(color.get(), depth.get(), "a float image")) {}

std::uint64_t FrameTarget::bytes() const {
  GLint red = 0;  // bits
  glGetTextureLevelParameteriv(color.get(), 0, GL_TEXTURE_RED_SIZE, &red);
  const auto perPixel = static_cast<std::uint64_t>(red / 8 * 4 + 4 + 4 + 16);
  return perPixel * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

}  // namespace lucarne
