#include "base/flip_filters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lucarne {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kStrip = 64;  // pixels summed at once, in registers

int radiusOf(const Taps& taps) { return static_cast<int>(taps.size() / 2); }

/// taps.size() rows of pixels, one tap each, into `out`.
void addRows(const std::vector<const float*>& rows, const Taps& taps, int width, float* out) {
  for (int x0 = 0; x0 < width; x0 += kStrip) {
    const int count = std::min(kStrip, width - x0);
    float sum[kStrip] = {};
    for (std::size_t k = 0; k < taps.size(); ++k) {
      const float* in = rows[k] + x0;
      const float w = taps[k];
      if (count == kStrip) {
        for (int i = 0; i < kStrip; ++i) sum[i] += w * in[i];
      } else {
        for (int i = 0; i < count; ++i) sum[i] += w * in[i];
      }
    }
    std::copy_n(sum, count, out + x0);
  }
}

/// exp(−π²x²/b), x in degrees: the Fourier transform of a Gaussian in frequency (Andersson et al. 2020, section 4.1).
Taps gaussian(double b, int radius, double pixelsPerDegree, double& sum) {
  std::vector<double> g;
  sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    const double x = i / pixelsPerDegree;
    g.push_back(std::exp(-kPi * kPi * x * x / b));
    sum += g.back();
  }
  Taps taps;
  for (const double v : g) taps.push_back(static_cast<float>(v / sum));
  return taps;
}

/// Scales positive and negative weights apart, each to a sum of 1.
Taps balanced(const std::vector<double>& weights) {
  double positive = 0, negative = 0;
  for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
  Taps taps;
  for (const double w : weights) taps.push_back(static_cast<float>(w / (w > 0 ? positive : negative)));
  return taps;
}

}  // namespace

Plane filterRows(const Plane& in, const Taps& taps) {
  Plane out(in.width, in.height);
  const int r = radiusOf(taps);
  tbb::parallel_for(0, in.height, [&](int y) {
    std::vector<float> padded(static_cast<std::size_t>(in.width + 2 * r));
    const float* row = in.row(y);
    std::fill_n(padded.begin(), r, row[0]);
    std::copy_n(row, in.width, padded.begin() + r);
    std::fill_n(padded.end() - r, r, row[in.width - 1]);
    std::vector<const float*> shifted;
    for (int k = 0; k <= 2 * r; ++k) shifted.push_back(padded.data() + k);
    addRows(shifted, taps, in.width, out.row(y));
  });
  return out;
}

Plane filterColumns(const Plane& in, const Taps& taps) {
  Plane out(in.width, in.height);
  const int r = radiusOf(taps);
  tbb::parallel_for(0, in.height, [&](int y) {
    std::vector<const float*> rows;
    for (int k = -r; k <= r; ++k) rows.push_back(in.row(std::clamp(y + k, 0, in.height - 1)));
    addRows(rows, taps, in.width, out.row(y));
  });
  return out;
}

// Table 1 of the paper; a sum of two Gaussians a·√(π/b)·exp(−π²z/b), of which all but blue-yellow have one only. Cut at
// three standard deviations of the widest, in all channels.
SensitivityFilters sensitivityFilters(double pixelsPerDegree) {
  constexpr double kAchromatic = 0.0047, kRedGreen = 0.0053;
  constexpr double kByA1 = 34.1, kByB1 = 0.04, kByA2 = 13.5, kByB2 = 0.025;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kByB1 / (2 * kPi * kPi)) * pixelsPerDegree));
  SensitivityFilters f;
  double sum = 0, sum1 = 0, sum2 = 0;
  f.achromatic = gaussian(kAchromatic, radius, pixelsPerDegree, sum);
  f.redGreen = gaussian(kRedGreen, radius, pixelsPerDegree, sum);
  f.blueYellow1 = gaussian(kByB1, radius, pixelsPerDegree, sum1);
  f.blueYellow2 = gaussian(kByB2, radius, pixelsPerDegree, sum2);
  // Over the square of taps the first Gaussian sums to a₁·√(π/b₁)·sum1², the second likewise.
  const double w1 = kByA1 * std::sqrt(kPi / kByB1) * sum1 * sum1, w2 = kByA2 * std::sqrt(kPi / kByB2) * sum2 * sum2;
  f.byFirst = static_cast<float>(w1 / (w1 + w2));
  return f;
}

// Section 4.2: a standard deviation of half the width of 0.082 degrees. In two dimensions the weights are a derivative
// along one axis times a Gaussian along the other, and their sign is that of the derivative, so that balancing the
// derivative and giving the Gaussian a sum of 1 balances the product.
FeatureFilters featureFilters(double pixelsPerDegree) {
  const double deviation = 0.5 * 0.082 * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> smooth, edge, point;
  for (int x = -radius; x <= radius; ++x) {
    const double g = std::exp(-x * x / (2 * deviation * deviation));
    smooth.push_back(g);
    edge.push_back(-x * g);
    point.push_back((x * x / (deviation * deviation) - 1) * g);
  }
  return {balanced(smooth), balanced(edge), balanced(point)};
}

}  // namespace lucarne
