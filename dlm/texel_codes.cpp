#include "dlm/texel_codes.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

constexpr int kMantissaBits = 9, kExponentBias = 15, kMaxExponent = 31;
constexpr float kLargest = 65408.f;  // (2⁹ − 1)/2⁹ · 2^(31 − 15)

std::uint32_t mantissa(float value, int exponent) {
  return static_cast<std::uint32_t>(std::lround(std::ldexp(value, kMantissaBits + kExponentBias - exponent)));
}

float clampValue(float v) { return v > 0 ? std::min(v, kLargest) : 0.f; }  // NaN: 0

}  // namespace

std::uint32_t packRgb9e5(Rgb value) {
  const Rgb c{clampValue(value.x), clampValue(value.y), clampValue(value.z)};
  const float largest = maxComponent(c);
  if (largest <= 0) return 0;
  int exponent = std::max(std::ilogb(largest) + 1 + kExponentBias, 0);
  if (mantissa(largest, exponent) == 1u << kMantissaBits) ++exponent;  // rounded up to the next power of two
  exponent = std::min(exponent, kMaxExponent);
  return mantissa(c.x, exponent) | mantissa(c.y, exponent) << 9 | mantissa(c.z, exponent) << 18 |
         static_cast<std::uint32_t>(exponent) << 27;
}

Rgb unpackRgb9e5(std::uint32_t bits) {
  const float unit = std::ldexp(1.f, static_cast<int>(bits >> 27) - kExponentBias - kMantissaBits);
  return Rgb{static_cast<float>(bits & 511u), static_cast<float>(bits >> 9 & 511u),
             static_cast<float>(bits >> 18 & 511u)} *
         unit;
}

std::uint32_t packLdr8(Rgb value, float scale) {
  std::uint32_t bits = 0;
  for (int c = 0; c < 3; ++c) {
    const float share = scale > 0 && value[c] > 0 ? value[c] / scale : 0.f;
    const auto code = static_cast<std::uint32_t>(std::lround(255 * std::sqrt(std::min(share, 1.f))));
    bits |= code << (8 * c);
  }
  return bits;
}

Rgb unpackLdr8(std::uint32_t bits, float scale) {
  Rgb value;
  for (int c = 0; c < 3; ++c) {
    const float root = static_cast<float>(bits >> (8 * c) & 255u) / 255;
    value[c] = root * root * scale;
  }
  return value;
}

}  // namespace lucarne
