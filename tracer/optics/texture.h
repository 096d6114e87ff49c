// Texture lookups of the tracer: bilinear (or nearest where the file says so), no mipmaps, glTF wrap modes.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "tracer/scene/scene.h"

namespace lucarne {

enum class Encoding : std::uint8_t { linear, srgb };

/// One use of one image, with all that a lookup needs at hand. White and opaque where there is no texture or no image.
class TextureReader {
 public:
  TextureReader() = default;
  /// `scene` must outlive this.
  TextureReader(const Scene& scene, const TextureUse& use, Encoding encoding);

  /// False where every lookup is white.
  explicit operator bool() const { return pixels_ != nullptr; }
  int uvSet() const { return uvSet_; }
  /// Red, green and blue at uv (before the use's transform), decoded before filtering.
  Rgb rgb(Vec2f uv) const;
  /// Pixels² of the parallelogram of two edges in texture coordinates.
  double pixelArea(Vec2f edge1, Vec2f edge2) const;
  /// Alpha, never decoded.
  float alpha(Vec2f uv) const;

 private:
  struct Place {  // four texels and the weights of the second ones
    std::array<std::size_t, 4> texel;
    float fx, fy;
  };
  Place place(Vec2f uv) const;

  const std::uint8_t* pixels_ = nullptr;  // RGBA
  const float* decode_ = nullptr;         // by code
  int width_ = 0, height_ = 0;
  Vec2f rowU_{1, 0}, rowV_{0, 1}, offset_{};
  Wrap wrapS_ = Wrap::repeat, wrapT_ = Wrap::repeat;
  bool nearest_ = false;
  std::uint8_t uvSet_ = 0;
};

}  // namespace lucarne
