// Light values in 32 bits. Rounded to nearest on the processor, so that no driver's rounding shows.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace lucarne {

/// GL_UNSIGNED_INT_5_9_9_9_REV of GL_RGB9_E5; negative components become 0, values above its largest (65408) that.
std::uint32_t packRgb9e5(Rgb value);
Rgb unpackRgb9e5(std::uint32_t bits);

/// Square roots of the components over `scale`, in steps of 1/255, red in the low byte: steps as fine as the eye's in
/// the dark. Negative components become 0, those above the scale 255; all are 0 for a scale of 0.
std::uint32_t packLdr8(Rgb value, float scale);
Rgb unpackLdr8(std::uint32_t bits, float scale);

}  // namespace lucarne
