#include "tracer/optics/texture.h"

#include <array>
#include <cmath>

#include "base/math.h"

namespace lucarne {
namespace {

/// Index of texel i on an axis of n texels.
int wrapIndex(int i, int n, Wrap wrap) {
  if (i >= 0 && i < n) return i;
  switch (wrap) {
    case Wrap::clampToEdge:
      return std::clamp(i, 0, n - 1);
    case Wrap::mirroredRepeat: {
      const int m = ((i % (2 * n)) + 2 * n) % (2 * n);
      return m < n ? m : 2 * n - 1 - m;
    }
    case Wrap::repeat:
      break;
  }
  return ((i % n) + n) % n;
}

/// Largest integer ≤ x, for |x| far below 2^31 (std::floor is a library call on the oldest processors we build for).
int floorToInt(float x) {
  const int i = static_cast<int>(x);
  return i - (static_cast<float>(i) > x);
}

/// Continuous coordinate in texels, brought near the image first so that huge coordinates cannot overflow an int.
float toTexels(float u, int n, Wrap wrap) {
  if (!std::isfinite(u)) return 0;
  if (wrap == Wrap::clampToEdge)
    u = std::clamp(u, -1.f, 2.f);
  else if (u < 0 || u >= 2)
    u -= 2.f * std::floor(u * 0.5f);
  return u * static_cast<float>(n);
}

using DecodeTable = std::array<float, 256>;

template <class F>
DecodeTable tabulate(F&& value) {
  DecodeTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = value(static_cast<std::uint8_t>(i));
  return table;
}

/// Value of each 8-bit code: a texel costs three loads.
const DecodeTable& decodeTable(Encoding encoding) {
  static const DecodeTable srgb = tabulate([](std::uint8_t code) { return srgbToLinear(code); });
  static const DecodeTable linear =
      tabulate([](std::uint8_t code) { return static_cast<float>(code) * (1.f / 255.f); });
  return encoding == Encoding::srgb ? srgb : linear;
}

Rgb texel(const Image& image, int x, int y, const DecodeTable& decode) {
  const auto* p = image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                           static_cast<std::size_t>(x));
  return {decode[p[0]], decode[p[1]], decode[p[2]]};
}

}  // namespace

Rgb lookUp(const Scene& scene, const TextureUse& use, Vec2f uv, Encoding encoding) {
  if (!use) return Rgb(1.f);
  const Texture& texture = scene.textures[use.texture];
  if (texture.image == kNone) return Rgb(1.f);
  const Image& image = scene.images[texture.image];
  const Vec2f st = Vec2f{dot(use.rowU, uv), dot(use.rowV, uv)} + use.offset;
  const float shift = texture.nearest ? 0.f : 0.5f;
  const float x = toTexels(st.x, image.width, texture.wrapS) - shift,
              y = toTexels(st.y, image.height, texture.wrapT) - shift;
  const DecodeTable& decode = decodeTable(encoding);
  const int x0 = floorToInt(x), y0 = floorToInt(y);
  const int ix = wrapIndex(x0, image.width, texture.wrapS), iy = wrapIndex(y0, image.height, texture.wrapT);
  if (texture.nearest) return texel(image, ix, iy, decode);
  const int jx = wrapIndex(x0 + 1, image.width, texture.wrapS), jy = wrapIndex(y0 + 1, image.height, texture.wrapT);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const Rgb top = texel(image, ix, iy, decode) * (1 - fx) + texel(image, jx, iy, decode) * fx;
  const Rgb bottom = texel(image, ix, jy, decode) * (1 - fx) + texel(image, jx, jy, decode) * fx;
  return top * (1 - fy) + bottom * fy;
}

}  // namespace lucarne
