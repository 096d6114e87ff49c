// How far a bake is from a constant known on paper, in standard errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/app/bake_fixture.h"

namespace lucarne::test {

inline constexpr double kPi64 = std::numbers::pi;

struct Deviation {
  double worst = 0;   // largest |z| of a texel
  double ofMean = 0;  // |z| of the mean by area
  std::uint64_t texels = 0;
};

/// Deviation of the luminance of all lit texels with surface from `expected`; `bias` is a relative error of the
/// expectation that is known and not held against the bake. A texel's standard error is the estimate scaled to what it
/// would be if `expected` were true (the variance of a count is in proportion to it), so that texels which happened to
/// get little light are not believed to be sure of it.
inline Deviation deviationFrom(const BakedScene& b, double expected, double bias = 0) {
  Deviation d;
  double flux = 0, area = 0;
  forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double a) {
    const double e = static_cast<double>(luminance(b.baked.maps.irradiance[t]));
    const double se = static_cast<double>(b.baked.maps.relativeError[t]) * std::sqrt(e * expected);
    ++d.texels;
    d.worst = std::max(d.worst, (std::abs(e - expected) - bias * expected) / se);
    flux += a * e;
    area += a;
  });
  // The number of bounces of a photon varies like a geometric one; its relative deviation is below 1.
  const double se = expected / std::sqrt(static_cast<double>(b.baked.ledger.photons));
  d.ofMean = (std::abs(flux / area - expected) - bias * expected) / se;
  return d;
}

/// Solid angle of a rectangle a × b from a point at height h over its middle (van Oosterom and Strackee 1983, four
/// equal parts): 4·atan(a·b / (2h·√(4h² + a² + b²))).
inline double solidAngleFromMiddle(double a, double b, double h) {
  return 4 * std::atan(a * b / (2 * h * std::sqrt(4 * h * h + a * a + b * b)));
}

/// Photons that a side got, texel by texel.
inline double photonsOf(const BakedScene& b, const SideMaps& side) {
  double sum = 0;
  for (std::uint64_t t = 0; side.lit && t < side.texelCount(); ++t)
    sum += static_cast<double>(b.baked.maps.photons[side.firstTexel + t]);
  return sum;
}

/// Flux on a side per area of it, lx, channel by channel.
inline Rgbd meanIrradiance(const BakedScene& b, const SideMaps& side) {
  Rgbd flux{};
  double area = 0;
  const std::uint64_t first = b.plan.layout.charts[side.chart].firstTexel;
  for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
    const double a = b.plan.layout.area[first + t];
    area += a;
    if (side.lit) flux += Rgbd(b.baked.maps.irradiance[side.firstTexel + t]) * a;
  }
  return flux / area;
}

/// All of a photon's share, tally units to fractions of the emitted flux.
inline double fraction(Int128 units) { return static_cast<double>(units) / static_cast<double>(kFixedPointOne); }

}  // namespace lucarne::test
