// Reconstruction kernels, applied to tallies when maps are made. Distances are in texels of the chart.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace lucarne {

/// adaptive: at each texel one of several pyramids, from none (the texel's own light) to `width`; see kernel_levels.h.
/// linear: the pyramid, but a plane instead of a mean is fitted under it; see side_resolver.h.
enum class KernelShape : std::uint8_t { pyramid, box, epanechnikov, adaptive, linear };

struct KernelOptions {
  KernelShape shape = KernelShape::pyramid;
  double width = 1.5;  // distance from the centre, in texels, at which the kernel ends (the paper's 1.5); ≥ 0.5
};

/// The paper's, and the widest that adaptive kernels choose from.
constexpr double defaultKernelWidth(KernelShape shape) { return shape == KernelShape::adaptive ? 4.5 : 1.5; }

/// Separable weights k(dx)·k(dy) for whole-texel offsets −radius … radius.
struct Kernel {
  int radius = 0;
  bool linear = false;          // weights lean where the surface lies to one side
  std::vector<double> weights;  // [offset + radius]
  double operator()(int offset) const { return weights[static_cast<std::size_t>(offset + radius)]; }
};

inline double kernelProfile(KernelShape shape, double relativeDistance) {
  if (relativeDistance >= 1) return 0;
  switch (shape) {
    case KernelShape::box: return 1;
    case KernelShape::epanechnikov: return 1 - relativeDistance * relativeDistance;
    case KernelShape::pyramid:
    case KernelShape::adaptive:
    case KernelShape::linear: break;
  }
  return 1 - relativeDistance;
}

/// Of adaptive kernels the widest.
inline Kernel makeKernel(const KernelOptions& options) {
  Kernel kernel;
  kernel.linear = options.shape == KernelShape::linear;
  while (kernelProfile(options.shape, (kernel.radius + 1) / options.width) > 0) ++kernel.radius;
  for (int d = -kernel.radius; d <= kernel.radius; ++d)
    kernel.weights.push_back(kernelProfile(options.shape, std::abs(d) / options.width));
  return kernel;
}

/// The kernels to choose from: one, or of an adaptive kernel those that end after 0.5, 1.5, 2.5, 4.5 … texels up to the width.
inline std::vector<Kernel> kernelLevels(const KernelOptions& options) {
  if (options.shape != KernelShape::adaptive) return {makeKernel(options)};
  std::vector<Kernel> levels;
  for (double width = 0.5, step = 1; width < options.width; width += step, step = width < 2 ? 1 : 2 * step)
    levels.push_back(makeKernel({KernelShape::pyramid, width}));
  levels.push_back(makeKernel({KernelShape::pyramid, options.width}));
  return levels;
}

}  // namespace lucarne
