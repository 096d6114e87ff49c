// What a frame is drawn into.
#pragma once

#include <cstdint>

#include "player/gl_objects.h"

namespace lucarne {

struct FrameTarget {
  /// `exact`: colour in 32-bit floats, else 16-bit. The sums of the multipass renderer are always 32-bit: blending into
  /// 16 bits drifts darker with every direction.
  FrameTarget(int width, int height, bool exact);

  /// Memory of all images.
  std::uint64_t bytes() const;

  int width, height;
  GlTexture color, depth, owner, lobe;
  GlFramebuffer prepass;  // owner + depth
  GlFramebuffer sums;     // lobe + depth
  GlFramebuffer shading;  // colour + depth
};

}  // namespace lucarne
