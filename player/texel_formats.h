// Packing of light values for textures, on the processor and rounded to nearest, so that no driver's rounding shows.
#pragma once

#include <cstdint>

#include "dlm/texel_codes.h"

namespace lucarne {

/// IEEE half; values must not exceed 65504. NaN becomes 0.
std::uint16_t packHalf(float value);
/// The power of two that brings `largest` into (16384, 32768]; 1 for zero or values that are not finite.
float halfScale(float largest);

}  // namespace lucarne
