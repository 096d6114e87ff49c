// The filters of FLIP, made of one-dimensional ones.
#pragma once

#include <vector>

namespace lucarne {

/// One channel of a picture.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;
  Plane() = default;
  Plane(int width_, int height_)
      : width(width_), height(height_), values(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

/// 2r + 1 weights, for the pixels from −r to r.
using Taps = std::vector<float>;

/// out(x) = Σ taps(i) · in(x + i) along rows or columns; pixels beyond the border repeat the last one.
Plane filterRows(const Plane& in, const Taps& taps);
Plane filterColumns(const Plane& in, const Taps& taps);

/// The eye's contrast sensitivity as a blur of each opponent channel. The blue-yellow one is a sum of two Gaussians,
/// each separable by itself; `byFirst` is the share of the first.
struct SensitivityFilters {
  Taps achromatic, redGreen, blueYellow1, blueYellow2;
  float byFirst = 0;
};
SensitivityFilters sensitivityFilters(double pixelsPerDegree);

/// Gaussian, its first derivative (edges) and its second (points); positive weights sum to 1, negative ones to −1.
struct FeatureFilters {
  Taps smooth, edge, point;
};
FeatureFilters featureFilters(double pixelsPerDegree);

}  // namespace lucarne
