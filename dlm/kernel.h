// Reconstruction kernels, applied to tallies when maps are made. Distances are in texels of the chart.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace lucarne {

enum class KernelShape : std::uint8_t { pyramid, box, epanechnikov };

struct KernelOptions {
  KernelShape shape = KernelShape::pyramid;
  double width = 1.5;  // distance from the centre, in texels, at which the kernel ends (the paper's 1.5); ≥ 0.5
};

/// Separable weights k(dx)·k(dy) for whole-texel offsets −radius … radius.
struct Kernel {
  int radius = 0;
  std::vector<double> weights;  // [offset + radius]
  double operator()(int offset) const { return weights[static_cast<std::size_t>(offset + radius)]; }
};

inline double kernelProfile(KernelShape shape, double relativeDistance) {
  if (relativeDistance >= 1) return 0;
  switch (shape) {
    case KernelShape::box: return 1;
    case KernelShape::epanechnikov: return 1 - relativeDistance * relativeDistance;
    case KernelShape::pyramid: break;
  }
  return 1 - relativeDistance;
}

inline Kernel makeKernel(const KernelOptions& options) {
  Kernel kernel;
  while (kernelProfile(options.shape, (kernel.radius + 1) / options.width) > 0) ++kernel.radius;
  for (int d = -kernel.radius; d <= kernel.radius; ++d)
    kernel.weights.push_back(kernelProfile(options.shape, std::abs(d) / options.width));
  return kernel;
}

}  // namespace lucarne
