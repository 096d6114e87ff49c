// The energy ledger: integers, so that its balance is exact and does not depend on the order of summing.
//
// Every photon's beta is followed in fixed point; each step books the difference of what came in and what goes on, so
// the terms telescope: emitted = absorbed + escaped + cut_off + roulette + shading_normal, per channel, to the last
// unit. `roulette` has mean zero. `incident` is another thing: it counts every bounce.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/vec.h"

namespace lucarne {

__extension__ typedef __int128 Int128;  // of GCC and Clang

/// Fixed point of tallies and ledger: units of 2^-24 of the scene's emitted flux.
inline constexpr int kFixedPointBits = 24;
inline constexpr float kFixedPointOne = 0x1p24f;

/// Sum of integers per channel; 128 bits never overflow.
struct FluxSum {
  std::array<Int128, 3> units{};
  FluxSum& operator+=(const FluxSum& o) {
    for (std::size_t c = 0; c < 3; ++c) units[c] += o.units[c];
    return *this;
  }
  friend bool operator==(const FluxSum&, const FluxSum&) = default;
};

/// beta in fixed point, to nearest. One rule for every booking, or the terms would not telescope. Scaling a float by a
/// power of two is exact, so the one rounding is that of llrint (an instruction, always to nearest).
struct FixedRgb {
  std::array<std::int64_t, 3> units{};
  FixedRgb() = default;
  explicit FixedRgb(Rgb beta) : units{toUnits(beta.x), toUnits(beta.y), toUnits(beta.z)} {}
  static std::int64_t toUnits(float v) { return std::llrint(v * kFixedPointOne); }
  FixedRgb& operator+=(const FixedRgb& b) {
    for (std::size_t c = 0; c < 3; ++c) units[c] += b.units[c];
    return *this;
  }
  friend FixedRgb operator-(FixedRgb a, const FixedRgb& b) {
    for (std::size_t c = 0; c < 3; ++c) a.units[c] -= b.units[c];
    return a;
  }
};
inline FluxSum& operator+=(FluxSum& sum, const FixedRgb& v) {
  for (std::size_t c = 0; c < 3; ++c) sum.units[c] += v.units[c];
  return sum;
}

struct Ledger {
  FluxSum emitted, absorbed, escaped, cutOff, roulette, shadingNormal;
  FluxSum expectedAbsorbed;  // Σ (1 − albedo)·beta over the hits
  FluxSum incident;          // stored light: Σ of all deposits, in the units of the tallies
  // Per photon, (absorbed − expected absorbed) summed over channels: its sum of squares gives the standard error.
  Int128 absorptionErrorSquares = 0;
  std::uint64_t photons = 0, rays = 0, hits = 0, storedHits = 0;
  std::uint64_t cutOffPaths = 0;     // reached the depth bound
  std::uint64_t repeatedRays = 0;    // met the triangle they left again, by rounding
  std::uint64_t clampedNormals = 0;  // shading-normal corrections that were clamped
  std::uint64_t strayValues = 0;     // NaN or negative beta met and dropped

  Ledger& operator+=(const Ledger& o);
  /// absorbed + escaped + cutOff + roulette + shadingNormal; equals `emitted` exactly.
  FluxSum balance() const;
};

}  // namespace lucarne
