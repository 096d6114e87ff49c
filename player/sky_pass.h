// The sky behind everything.
#pragma once

#include "base/image_file.h"
#include "player/frame_target.h"

namespace lucarne {

class SkyPass {
 public:
  /// `image`: equirectangular as tracer/optics/environment.h says, cd/m². `outputScale`: target units per cd/m². Needs
  /// a current context. Error(outOfResource) when the map does not fit.
  SkyPass(const ImageRgb& image, float outputScale);

  /// Fills target.shading where the pre-pass found nothing. The camera's uniforms are bound.
  void draw(const FrameTarget& target) const;

  std::uint64_t bytes() const { return bytes_; }

 private:
  GlProgram program_;
  GlVertexArray nothing_;
  GlTexture image_;
  std::uint64_t bytes_;
};

}  // namespace lucarne
