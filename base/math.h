// Elementary functions in plain arithmetic. The C library's differ in the last bit between versions and processors, and
// the traced path must give the same bits everywhere; these are made of additions, products, quotients, square roots
// and bit patterns, each of which IEEE 754 fixes. (Compiled without contraction to fused operations.)
//
// Errors named here are the largest seen against higher precision over dense samples. Arguments are finite; NaN gives
// NaN.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace lucarne {

inline constexpr double kPiD = 3.14159265358979323846;

/// 2^exponent, for exponents of normal numbers.
inline double powerOfTwo(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// sin(πx) and cos(πx), exact reduction for any finite x; error < 3e-16, multiples of 1/2 exact.
double sinPi(double x);
double cosPi(double x);

/// Cube root with the sign of x; relative error < 4e-16.
double cbrt(double x);

/// e^x; relative error < 4e-16 where the result is a normal number, 0 or infinity beyond.
double exp(double x);

/// Natural logarithm, error < 1 unit in the last place; −infinity at 0, NaN below.
double log(double x);

/// x^y for x ≥ 0; relative error < 4e-16 (1 + |y·ln x|). x^0 = 1; NaN for x < 0.
double pow(double x, double y);

/// Angle of (x, y) in [−π, π], as std::atan2; error < 5e-16 relative.
double atan2(double y, double x);

/// Arc cosine; arguments beyond ±1 (by rounding) are taken as ±1. Relative error < 1e-15.
double acos(double x);

/// s = sin(2πu), c = cos(2πu) for u in [0, 1]; error < 2e-7 each. Eighths of a turn are taken off exactly, then Taylor.
inline void sinCosTurns(float u, float& s, float& c) {
  const int quarter = static_cast<int>(u * 4.f + 0.5f);
  const float x = (u - 0.25f * static_cast<float>(quarter)) * 6.28318530718f;  // |x| ≤ π/4
  const float z = x * x;
  const float sine = x + x * z * (-1.6666654611e-1f + z * (8.3321608736e-3f - z * 1.9515295891e-4f));
  const float cosine =
      1.f - 0.5f * z + z * z * (4.166664568298827e-2f + z * (-1.388731625493765e-3f + z * 2.443315711809948e-5f));
  // In odd quarters the two change places; sine is negative in quarters 2 and 3, cosine in 1 and 2. All without a branch,
  // which could not be foretold.
  const auto sineBits = std::bit_cast<std::uint32_t>(sine), cosineBits = std::bit_cast<std::uint32_t>(cosine);
  const std::uint32_t change = (sineBits ^ cosineBits) & (0u - static_cast<std::uint32_t>(quarter & 1));
  const auto signS = static_cast<std::uint32_t>(quarter & 2) << 30;
  const auto signC = static_cast<std::uint32_t>((quarter + 1) & 2) << 30;
  s = std::bit_cast<float>(sineBits ^ change ^ signS);
  c = std::bit_cast<float>(cosineBits ^ change ^ signC);
}

/// Linear value of an 8-bit sRGB code (IEC 61966-2-1).
float srgbToLinear(std::uint8_t code);
/// The same for a real code in [0, 1].
double srgbToLinear(double code);

/// sRGB code in [0, 1] of a linear value; values outside [0, 1] and NaN are clamped (NaN to 0).
double linearToSrgb(double linear);
/// Nearest 8-bit code: srgbByte(srgbToLinear(i)) = i.
std::uint8_t srgbByte(double linear);

}  // namespace lucarne
