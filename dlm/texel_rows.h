// Texels of a page of directional.exr as numbers.
#pragma once

#include <Imath/half.h>

#include <cstring>

#include "dlm/directional_file.h"
#include "dlm/texel_codes.h"

namespace lucarne {

template <class T>
T texelAt(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

inline float fromHalf(std::uint16_t bits) { return imath_half_to_float(bits); }

/// Calls use(i, value) for each of `count` texels from `row` on: what the file holds, to be multiplied by its scale. Of
/// TexelKind::code these must be RGB9E5.
template <class Use>
void forEachValue(TexelKind kind, const std::byte* row, std::size_t count, const Use& use) {
  const auto each = [&](const auto& valueAt) {
    for (std::size_t i = 0; i < count; ++i) use(i, valueAt(row + i * bytesOf(kind)));
  };
  switch (kind) {
    case TexelKind::rgbHalf:
      return each([](const std::byte* t) {
        return Rgb{fromHalf(texelAt<std::uint16_t>(t)), fromHalf(texelAt<std::uint16_t>(t + 2)), fromHalf(texelAt<std::uint16_t>(t + 4))};
      });
    case TexelKind::greyHalf:
      return each([](const std::byte* t) { return Rgb(fromHalf(texelAt<std::uint16_t>(t))); });
    case TexelKind::rgbFloat:
      return each([](const std::byte* t) { return texelAt<Rgb>(t); });
    case TexelKind::greyFloat:
      return each([](const std::byte* t) { return Rgb(texelAt<float>(t)); });
    case TexelKind::code:
      return each([](const std::byte* t) { return unpackRgb9e5(texelAt<std::uint32_t>(t)); });
  }
}

}  // namespace lucarne
