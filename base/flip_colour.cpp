#include "base/flip_colour.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

// White of the matrices below, and its inverse.
constexpr Vec3f kWhite{0.950428545f, 1.f, 1.088900371f};
constexpr Vec3f kPerWhite{1.052156925f, 1.f, 0.918357670f};

Vec3f xyzFromRgb(Rgb c) {
  constexpr float kX = 1.f / 24577794.f, kY = 1.f / 12288897.f, kZ = 1.f / 73733382.f;
  return {(10135552.f * c.x + 8788810.f * c.y + 4435075.f * c.z) * kX,
          (2613072.f * c.x + 8788810.f * c.y + 887015.f * c.z) * kY,
          (1425312.f * c.x + 8788810.f * c.y + 70074185.f * c.z) * kZ};
}

Rgb rgbFromXyz(Vec3f c) {
  return {3.241003275f * c.x - 1.537398934f * c.y - 0.498615861f * c.z,
          -0.969224334f * c.x + 1.875930071f * c.y + 0.041554224f * c.z,
          0.055639423f * c.x - 0.204011202f * c.y + 1.057148933f * c.z};
}

float labCurve(float t) {
  constexpr float kDelta = 6.f / 29.f;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.f / 29.f;
}

// (k0 x² + k1 x) / (k3 x² + k4 x + k5); 0.6 takes back the exposure that the fit has built in.
constexpr double kA = 0.6 * 0.6 * 2.51, kB = 0.6 * 0.03, kC = 0.6 * 0.6 * 2.43, kD = 0.6 * 0.59, kE = 0.14;

}  // namespace

Vec3f opponentFromRgb(Rgb linear) {
  const Vec3f t = xyzFromRgb(linear) * kPerWhite;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

Rgb rgbFromOpponent(Vec3f c) {
  const float y = (c.x + 16) / 116;
  return rgbFromXyz(Vec3f{y + c.y / 500, y, y - c.z / 200} * kWhite);
}

Vec3f huntLabFromRgb(Rgb linear) {
  const Vec3f t = xyzFromRgb(linear) * kPerWhite;
  const float x = labCurve(t.x), y = labCurve(t.y), z = labCurve(t.z), L = 116 * y - 16;
  return {L, 0.01f * L * 500 * (x - y), 0.01f * L * 200 * (y - z)};
}

float hyab(Vec3f a, Vec3f b) {
  return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

float flipToneCurve(float exposed) {
  constexpr float a = kA, b = kB, c = kC, d = kD, e = kE;
  const float x = std::clamp(exposed, 0.f, 1e6f);
  return std::clamp(x * (a * x + b) / (x * (c * x + d) + e), 0.f, 1.f);
}

double inverseFlipToneCurve(double shown) {
  const double p = (kB - kD * shown) / (kA - kC * shown), q = -kE * shown / (kA - kC * shown);
  return -0.5 * p + std::sqrt(0.25 * p * p - q);
}

}  // namespace lucarne
