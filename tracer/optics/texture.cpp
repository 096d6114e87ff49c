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

}  // namespace

TextureReader::TextureReader(const Scene& scene, const TextureUse& use, Encoding encoding) {
  if (!use || scene.textures[use.texture].image == kNone) return;
  const Texture& texture = scene.textures[use.texture];
  const Image& image = scene.images[texture.image];
  if (image.rgba.empty()) return;
  pixels_ = image.rgba.data();
  decode_ = decodeTable(encoding).data();
  width_ = image.width;
  height_ = image.height;
  rowU_ = use.rowU;
  rowV_ = use.rowV;
  offset_ = use.offset;
  wrapS_ = texture.wrapS;
  wrapT_ = texture.wrapT;
  nearest_ = texture.nearest;
  uvSet_ = use.uvSet == 0 ? 0 : 1;
}

/// A nearest lookup is a bilinear one whose weights are 0.
TextureReader::Place TextureReader::place(Vec2f uv) const {
  const Vec2f st = Vec2f{dot(rowU_, uv), dot(rowV_, uv)} + offset_;
  const float shift = nearest_ ? 0.f : 0.5f;
  const float x = toTexels(st.x, width_, wrapS_) - shift, y = toTexels(st.y, height_, wrapT_) - shift;
  const int x0 = floorToInt(x), y0 = floorToInt(y);
  const int ix = wrapIndex(x0, width_, wrapS_), iy = wrapIndex(y0, height_, wrapT_);
  const int jx = wrapIndex(x0 + 1, width_, wrapS_), jy = wrapIndex(y0 + 1, height_, wrapT_);
  const auto at = [this](int column, int row) {
    return 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column));
  };
  return {{at(ix, iy), at(jx, iy), at(ix, jy), at(jx, jy)},
          nearest_ ? 0.f : x - static_cast<float>(x0),
          nearest_ ? 0.f : y - static_cast<float>(y0)};
}

double TextureReader::pixelArea(Vec2f edge1, Vec2f edge2) const {
  const auto turned = [this](Vec2f e) {
    return Vec2d{static_cast<double>(dot(rowU_, e)), static_cast<double>(dot(rowV_, e))};
  };
  const Vec2d a = turned(edge1), b = turned(edge2);
  return std::abs(a.x * b.y - a.y * b.x) * width_ * height_;
}

Rgb TextureReader::rgb(Vec2f uv) const {
  if (pixels_ == nullptr) return Rgb(1.f);
  const Place p = place(uv);
  const auto texel = [this](std::size_t at) {
    return Rgb{decode_[pixels_[at]], decode_[pixels_[at + 1]], decode_[pixels_[at + 2]]};
  };
  const Rgb top = texel(p.texel[0]) * (1 - p.fx) + texel(p.texel[1]) * p.fx;
  const Rgb bottom = texel(p.texel[2]) * (1 - p.fx) + texel(p.texel[3]) * p.fx;
  return top * (1 - p.fy) + bottom * p.fy;
}

float TextureReader::alpha(Vec2f uv) const {
  if (pixels_ == nullptr) return 1;
  const Place p = place(uv);
  const auto texel = [this](std::size_t at) { return static_cast<float>(pixels_[at + 3]) * (1.f / 255.f); };
  const float top = texel(p.texel[0]) * (1 - p.fx) + texel(p.texel[1]) * p.fx;
  const float bottom = texel(p.texel[2]) * (1 - p.fx) + texel(p.texel[3]) * p.fx;
  return top * (1 - p.fy) + bottom * p.fy;
}

}  // namespace lucarne
