// What one chart side knows of its error: see texel_error.h.
#pragma once

#include <vector>

#include "dlm/side_input.h"
#include "dlm/texel_error.h"

namespace lucarne {

/// Of one set of tallies; empty where the set says nothing.
struct SetErrors {
  std::vector<float> deviations;             // of independent photons, lx
  std::vector<std::uint8_t> photonClasses;   // see ErrorRatios
  ErrorRatios ratios;
};

struct SideErrors {
  SetErrors photons, direct;
  /// Standard errors, lx, by texel; `all…`: sums of the ratios over all sides.
  std::vector<float> deviations(const ErrorRatios& allPhotons, const ErrorRatios& allDirect) const;
};

/// `photonIrradiance`: of the first set, filtered; lx.
SideErrors sideErrors(const SideInput& side, const std::vector<Rgbd>& photonIrradiance);

/// Luminance of the whole light of a side's texels and its variance, lx, with `side`'s resolver.
LevelEstimate estimateOf(const SideInput& side);

}  // namespace lucarne
