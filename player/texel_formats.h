// Packing of light values for textures, on the processor and rounded to nearest, so that no driver's rounding shows.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace lucarne {

/// IEEE half; values must not exceed 65504. NaN becomes 0.
std::uint16_t packHalf(float value);
/// GL_UNSIGNED_INT_5_9_9_9_REV of GL_RGB9_E5; negative components become 0, values above its largest (65408) that.
std::uint32_t packRgb9e5(Rgb value);
Rgb unpackRgb9e5(std::uint32_t bits);

/// The power of two that brings `largest` into (16384, 32768]; 1 for zero or values that are not finite.
float halfScale(float largest);

}  // namespace lucarne
