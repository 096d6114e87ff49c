// Kernels that fit a plane.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "dlm/side_resolver.h"

namespace lucarne::local_linear_test {
namespace {

constexpr int kWidth = 12, kHeight = 9;

/// The tallies of light that varies over the texels' centres, on a surface of given area in each texel.
struct Light {
  std::vector<double> area, tallies, truth;

  Light(const std::function<double(int, int)>& areaAt, const std::function<double(double, double)>& value) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        area.push_back(areaAt(x, y));
        truth.push_back(value(x, y));
        tallies.push_back(area.back() * truth.back());
      }
  }
  std::vector<double> resolved(const KernelOptions& options) const {
    const Kernel kernel = makeKernel(options);
    const SideContacts contacts;
    return SideResolver(kWidth, kHeight, area, kernel, contacts).filterValues(tallies);
  }
  /// Largest error over the texels with surface.
  double worst(const KernelOptions& options) const {
    const std::vector<double> values = resolved(options);
    double most = 0;
    for (std::size_t t = 0; t < values.size(); ++t)
      if (area[t] > 0) most = std::max(most, std::abs(values[t] - truth[t]));
    return most;
  }
};

double everywhere(int, int) { return 0.25; }
/// A triangle: whole texels, halves along its long edge, nothing beyond.
double triangle(int x, int y) { return x + y < 9 ? 1.0 : x + y == 9 ? 0.5 : 0.0; }
double slope(double x, double y) { return 10 + 2 * x - y; }

TEST(LocalLinear, LinearLightIsExactUpToTheEdgesWhereMeansAreNot) {
  for (const double width : {1.5, 2.5}) {
    EXPECT_LT(Light(everywhere, slope).worst({KernelShape::linear, width}), 1e-9) << width;
    EXPECT_GT(Light(everywhere, slope).worst({KernelShape::pyramid, width}), 0.3) << width;
  }
}

TEST(LocalLinear, LinearLightIsExactOnASlantedEdge) {
  const Light light(triangle, slope);
  EXPECT_LT(light.worst({KernelShape::linear, 2.5}), 1e-9);
  EXPECT_GT(light.worst({KernelShape::pyramid, 2.5}), 1);
}

TEST(LocalLinear, ConstantLightStaysConstant) {
  const Light light(triangle, [](double, double) { return 3.0; });
  EXPECT_LT(light.worst({KernelShape::linear, 3.5}), 1e-12);
}

TEST(LocalLinear, InTheMiddleOfAChartIsThePyramid) {
  const Light light(everywhere, [](double x, double y) { return 1 + std::cos(x) + x * y * y; });
  const auto linear = light.resolved({KernelShape::linear, 2.5}), pyramid = light.resolved({KernelShape::pyramid, 2.5});
  for (int y = 2; y < kHeight - 2; ++y)
    for (int x = 2; x < kWidth - 2; ++x)
      EXPECT_NEAR(linear[static_cast<std::size_t>(y * kWidth + x)], pyramid[static_cast<std::size_t>(y * kWidth + x)], 1e-12);
}

TEST(LocalLinear, NeverMakesLightNegative) {
  std::mt19937 random(5);
  std::exponential_distribution<double> spike(1);
  for (int i = 0; i < 50; ++i) {
    const Light light([&](int x, int y) { return (x * 7 + y * 5 + i) % 3 == 0 ? 0.0 : spike(random); },
                      [&](double, double) { return spike(random) > 2 ? 1000.0 : 0.0; });
    for (const double v : light.resolved({KernelShape::linear, 0.5 + i % 5})) EXPECT_GE(v, 0);
  }
}

TEST(LocalLinear, ARowAColumnAndATexelOfSurfaceAreNoTrouble) {
  const auto row = [](int, int y) { return y == 4 ? 1.0 : 0.0; };
  const auto column = [](int x, int) { return x == 4 ? 1.0 : 0.0; };
  const auto texel = [](int x, int y) { return x == 4 && y == 4 ? 1.0 : 0.0; };
  for (const auto& area : {std::function<double(int, int)>(row), std::function<double(int, int)>(column)})
    EXPECT_LT(Light(area, slope).worst({KernelShape::linear, 1.5}), 1e-9);
  const Light alone(texel, slope);
  for (const double v : alone.resolved({KernelShape::linear, 2.5})) EXPECT_DOUBLE_EQ(v, slope(4, 4));
}

}  // namespace
}  // namespace lucarne::local_linear_test
