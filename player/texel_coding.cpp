#include "player/texel_coding.h"

#include <array>
#include <cstring>

#include "player/texel_formats.h"

namespace lucarne {
namespace {

/// Each value times the scale, as `code` makes it.
template <auto code>
void writeCoded(std::span<const Rgb> values, float scale, std::byte* to) {
  for (const Rgb& value : values) {
    const auto texel = code(value * scale);
    std::memcpy(to, &texel, sizeof texel);
    to += sizeof texel;
  }
}

}  // namespace

TexelCoding codingOf(LightMapFormat format) {
  constexpr auto asHalf = [](Rgb v) {
    return std::array<std::uint16_t, 4>{packHalf(v.x), packHalf(v.y), packHalf(v.z), 0};
  };
  switch (format) {
    case LightMapFormat::float32:
      return {{GL_RGBA32F, GL_RGB, GL_FLOAT, 12}, writeCoded<[](Rgb v) { return v; }>};
    case LightMapFormat::rgb9e5:
      return {{GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, 4}, writeCoded<packRgb9e5>};
    case LightMapFormat::half:
      break;
  }
  return {{GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8}, writeCoded<asHalf>};
}

}  // namespace lucarne
