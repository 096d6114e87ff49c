#include "dlm/mean_direction.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

constexpr float kSteps = 1023;

std::uint32_t packComponent(float v) {
  return static_cast<std::uint32_t>(std::lround((std::clamp(v, -1.f, 1.f) * 0.5f + 0.5f) * kSteps));
}

float unpackComponent(std::uint32_t code) { return static_cast<float>(code & 0x3ffu) * (2 / kSteps) - 1; }

}  // namespace

float meanReach(int directionCount, DirectionFilter filter) {
  const float cells = filter == DirectionFilter::linear ? 5.5f : 3.f;
  return std::min(2.f, cells / std::sqrt(static_cast<float>(directionCount)));
}

std::uint32_t packMean(Vec3f mean, Vec3f psi, float reach) {
  const Vec3f v = (mean - psi) / reach;
  return packComponent(v.x) | packComponent(v.y) << 10 | packComponent(v.z) << 20;
}

Vec3f unpackMean(std::uint32_t code, Vec3f psi, float reach) {
  const Vec3f v{unpackComponent(code), unpackComponent(code >> 10), unpackComponent(code >> 20)};
  return boundedMean(psi + v * reach);
}

Vec3f boundedMean(Vec3f mean) {
  const float square = dot(mean, mean);
  return square > 1 ? mean / std::sqrt(square) : mean;
}

}  // namespace lucarne
