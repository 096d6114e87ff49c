// Numbers as colours.
#pragma once

#include <array>
#include <cstdint>

namespace lucarne {

/// 0 … 1 as black, violet, red, orange, pale yellow (eight steps of the colours called magma, with straight lines
/// between): lightness grows all the way, so that it reads in grey, too. Display codes. Values outside are clamped, NaN
/// is 0.
std::array<std::uint8_t, 3> heatColour(double value);

}  // namespace lucarne
