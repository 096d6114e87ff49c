// What stands for the window's own picture where there is no window.
#pragma once

#include <cstdint>
#include <vector>

#include "player/gl_objects.h"
#include "player/read_back.h"

namespace lucarne {

struct ScreenImage {
  ScreenImage(int width_, int height_)
      : width(width_),
        height(height_),
        color(makeTexture({GL_TEXTURE_2D, GL_RGBA8, 1, width, height, 1})),
        framebuffer(makeFramebuffer(color.get(), 0, "an 8-bit image")) {}

  /// 3 bytes a pixel, top row first.
  std::vector<std::uint8_t> read() const { return readBackBytes(framebuffer.get(), width, height); }

  int width, height;
  GlTexture color;
  GlFramebuffer framebuffer;
};

}  // namespace lucarne
