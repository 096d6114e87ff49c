#include "player/texel_formats.h"

#include <cmath>
#include <glm/gtc/packing.hpp>

namespace lucarne {
namespace {

constexpr int kMantissaBits = 9, kExponentBias = 15, kMaxExponent = 31;
constexpr float kLargest = 65408.f;  // (2⁹ − 1)/2⁹ · 2^(31 − 15)

std::uint32_t mantissa(float value, int exponent) {
  return static_cast<std::uint32_t>(std::lround(std::ldexp(value, kMantissaBits + kExponentBias - exponent)));
}

float clampValue(float v) { return v > 0 ? std::min(v, kLargest) : 0.f; }  // NaN: 0

}  // namespace

std::uint16_t packHalf(float value) { return std::isnan(value) ? std::uint16_t{0} : glm::packHalf1x16(value); }

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

float halfScale(float largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 1.f;
  int exponent = 0;
  std::frexp(largest, &exponent);  // largest in [2^(e−1), 2^e)
  return std::ldexp(1.f, std::clamp(15 - exponent, -126, 126));
}

}  // namespace lucarne
