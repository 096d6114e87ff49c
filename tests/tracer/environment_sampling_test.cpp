// Statistics of Environment::sample(): its histogram is its density, and what is estimated with it is right; each test
// rejects a density or a value that is a little wrong.
#include <gtest/gtest.h>

#include <random>

#include "base/math.h"
#include "tests/support/statistics.h"
#include "tests/tracer/environment_maps.h"
#include "tracer/optics/environment.h"

namespace lucarne::environment_sampling_test {
namespace {

constexpr int kWidth = 48, kHeight = 25;  // of the map
constexpr int kAcross = 20, kDown = 16;   // bins of equal solid angle, not along the borders of pixels
constexpr int kSamples = 1000000;

/// Sorted borders of n equal steps from `from` to `to`, and those of the map's rows or columns.
std::vector<double> withBorders(std::vector<double> borders, int n, double from, double to) {
  for (int i = 0; i <= n; ++i) borders.push_back(from + (to - from) * i / n);
  std::sort(borders.begin(), borders.end());
  return borders;
}

int binOf(double x, int n) { return std::clamp(static_cast<int>(x * n), 0, n - 1); }

int binOf(Vec3d w) {
  return binOf((1 + w.y) / 2, kDown) * kAcross + binOf(std::atan2(w.z, w.x) / (2 * kPiD) + 0.5, kAcross);
}

/// Integral of `density` over each bin, exact for one that is constant within pixels: cut at all borders of both.
template <class Density>
std::vector<double> binIntegrals(Density density) {
  std::vector<double> rows, columns, sums(kAcross * kDown);
  for (int y = 0; y <= kHeight; ++y) rows.push_back(std::cos(kPiD * y / kHeight));
  for (int x = 0; x <= kWidth; ++x) columns.push_back(kPiD * (2.0 * x / kWidth - 1));
  rows = withBorders(rows, kDown, -1, 1);
  columns = withBorders(columns, kAcross, -kPiD, kPiD);
  for (std::size_t y = 1; y < rows.size(); ++y) {
    for (std::size_t x = 1; x < columns.size(); ++x) {
      const double area = (rows[y] - rows[y - 1]) * (columns[x] - columns[x - 1]);
      if (area < 1e-12) continue;  // two borders that are one
      const double cosine = (rows[y] + rows[y - 1]) / 2, azimuth = (columns[x] + columns[x - 1]) / 2;
      const double sine = std::sqrt(1 - cosine * cosine);
      const Vec3d w(sine * std::cos(azimuth), cosine, sine * std::sin(azimuth));
      sums[static_cast<std::size_t>(binOf(w))] += density(Vec3f(w)) * area;
    }
  }
  return sums;
}

class EnvironmentSampling : public ::testing::Test {
 protected:
  std::vector<double> histogram() {
    std::vector<double> counts(kAcross * kDown);
    for (int i = 0; i < kSamples; ++i) ++counts[static_cast<std::size_t>(binOf(Vec3d(next().direction)))];
    return counts;
  }
  Environment::Sample next() { return next(sky_); }
  Environment::Sample next(const Environment& sky) {
    const double u = number_(random_);
    return sky.sample(u, number_(random_));
  }
  /// p-value of the histogram against a density, normalised.
  template <class Density>
  static double pValue(const std::vector<double>& counts, Density density) {
    std::vector<double> expected = binIntegrals(density);
    double sum = 0;
    for (const double e : expected) sum += e;
    for (double& e : expected) e *= kSamples / sum;
    return test::chiSquareP(counts, expected);
  }

  const ImageRgb map_ = test::sunMap(kWidth, kHeight);
  const Environment sky_{map_, "sky"};
  std::mt19937_64 random_{11};
  std::uniform_real_distribution<double> number_{0, 1};
};

TEST_F(EnvironmentSampling, TheHistogramIsTheDensity) {
  double total = 0;
  for (const double bin : binIntegrals([&](Vec3f w) { return sky_.pdf(w); })) total += bin;
  EXPECT_NEAR(total, 1, 1e-9);
  EXPECT_GT(pValue(histogram(), [&](Vec3f w) { return sky_.pdf(w); }), 1e-4);
}

TEST_F(EnvironmentSampling, TheHistogramIsNoDensityThatIsALittleWrong) {
  const std::vector<double> counts = histogram();
  EXPECT_LT(pValue(counts, [&](Vec3f w) { return sky_.pdf(w) + 0.004 / (4 * kPiD); }), 1e-9);
  EXPECT_LT(pValue(counts, [&](Vec3f w) { return sky_.pdf(w) / std::sqrt(1.0001 - w.y * w.y); }), 1e-9);
  EXPECT_LT(pValue(counts, [&](Vec3f w) { return sky_.pdf({-w.x, w.y, -w.z}); }), 1e-9);
  EXPECT_LT(pValue(counts, [&](Vec3f w) { return sky_.pdf({w.x, w.y, -w.z}); }), 1e-9);
}

/// ∫ L max(0, n·w) dω by midpoints of 12 × 12 pieces of each pixel: relative error about 1e-5.
Rgbd irradiance(const ImageRgb& map, Vec3d n) {
  constexpr int kCuts = 12;
  Rgbd sum;
  for (int y = 0; y < kHeight * kCuts; ++y) {
    const double area = 2 * kPiD / (kWidth * kCuts) *
                        (std::cos(kPiD * y / (kHeight * kCuts)) - std::cos(kPiD * (y + 1) / (kHeight * kCuts)));
    for (int x = 0; x < kWidth * kCuts; ++x) {
      const Vec3d w(test::pixelCentre(x, y, kWidth * kCuts, kHeight * kCuts));
      const Rgb& pixel = map.pixels[static_cast<std::size_t>(y / kCuts * kWidth + x / kCuts)];
      sum += Rgbd(pixel) * (std::max(0.0, dot(n, w)) * area);
    }
  }
  return sum;
}

/// Of a million samples: within their standard error, and near enough to tell a value that is 3 % wrong.
class EnvironmentIrradiance : public EnvironmentSampling,
                              public ::testing::WithParamInterface<std::pair<double, Vec3d>> {};

TEST_P(EnvironmentIrradiance, FromSamplesIsTheSumOverPixels) {
  const auto& [peak, n] = GetParam();
  const ImageRgb map = test::sunMap(kWidth, kHeight, peak);
  const Environment sky(map, "sky");
  Rgbd sum, squares;
  for (int i = 0; i < kSamples; ++i) {
    const Environment::Sample s = next(sky);
    const Rgbd value = Rgbd(s.radiance) * (std::max(0.0, dot(n, Vec3d(s.direction))) / s.pdf);
    sum += value;
    squares += value * value;
  }
  const Rgbd exact = irradiance(map, n), estimate = sum / double(kSamples);
  for (int c = 0; c < 3; ++c) {
    const double error = std::sqrt((squares[c] / kSamples - estimate[c] * estimate[c]) / kSamples);
    const double allowed = test::zThreshold(15) * error + 3e-5 * exact[c];
    EXPECT_NEAR(estimate[c], exact[c], allowed);
    EXPECT_GT(std::abs(estimate[c] - 1.03 * exact[c]), allowed);
  }
}

// A sun of a third of all the light, seen and not seen; and one of nearly all of it, seen.
INSTANTIATE_TEST_SUITE_P(Normals, EnvironmentIrradiance,
                         ::testing::Values(std::pair(500.0, Vec3d(0, 1, 0)), std::pair(500.0, Vec3d(0, -1, 0)),
                                           std::pair(500.0, normalize(Vec3d(1, 2, -3))),
                                           std::pair(500.0, normalize(Vec3d(2, -0.5, 1))),
                                           std::pair(1e5, normalize(Vec3d(-2, 3, -1)))));

}  // namespace
}  // namespace lucarne::environment_sampling_test
