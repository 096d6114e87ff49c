#include "base/heat_colour.h"

#include <algorithm>
#include <cmath>

namespace lucarne {

std::array<std::uint8_t, 3> heatColour(double value) {
  constexpr double kSteps[][3] = {{0, 0, 4},      {28, 16, 68},   {79, 18, 123},   {129, 37, 129}, {181, 54, 122},
                                  {229, 80, 100}, {251, 135, 97}, {254, 194, 135}, {252, 253, 191}};
  constexpr int kLast = 8;
  const double at = value > 0 ? std::min(value, 1.0) * kLast : 0;  // NaN: 0
  const int step = std::min(static_cast<int>(at), kLast - 1);
  std::array<std::uint8_t, 3> code{};
  for (std::size_t i = 0; i < 3; ++i) {
    code[i] = static_cast<std::uint8_t>(std::lround(std::lerp(kSteps[step][i], kSteps[step + 1][i], at - step)));
  }
  return code;
}

}  // namespace lucarne
