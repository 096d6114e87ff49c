// How a texel of the directional maps is stored on the GPU.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>

#include "base/vec.h"
#include "player/render_options.h"

namespace lucarne {

struct PixelCoding {
  GLenum internal, layout, type;
  std::size_t bytes;
};

struct TexelCoding : PixelCoding {
  /// Each value times the scale.
  void (*writeRow)(std::span<const Rgb> values, float scale, std::byte* to);
};

TexelCoding codingOf(LightMapFormat format);

}  // namespace lucarne
