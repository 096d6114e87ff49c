#include "player/texel_formats.h"

#include <cmath>
#include <glm/gtc/packing.hpp>

namespace lucarne {
std::uint16_t packHalf(float value) { return std::isnan(value) ? std::uint16_t{0} : glm::packHalf1x16(value); }

float halfScale(float largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 1.f;
  int exponent = 0;
  std::frexp(largest, &exponent);  // largest in [2^(e−1), 2^e)
  return std::ldexp(1.f, std::clamp(15 - exponent, -126, 126));
}

}  // namespace lucarne
