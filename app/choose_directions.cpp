#include "app/choose_directions.h"

#include <array>
#include <cmath>

#include "dlm/lobe_width.h"
#include "dlm/needs.h"
#include "tracer/optics/phong.h"
#include "tracer/optics/surface.h"

namespace lucarne {
namespace {

constexpr std::array kSizes = {14, 32, 64};
constexpr double kEnough = 0.9;

/// What one material asks for.
struct Demand {
  bool glossy = false;
  double reflects = 0, sharpness = 0;
};

Demand demandOf(const Material& material) {
  if (needOf(material) != Need::directions) return {};
  const Bsdf bsdf = makeBsdf(material, factorsOf(material));
  return {true, static_cast<double>(luminance(bsdf.f0)), static_cast<double>(phongFromAlpha(bsdf.alpha)) + 1};
}

}  // namespace

DirectionChoice chooseDirections(const Scene& scene) {
  std::vector<Demand> demands;
  for (const Material& m : scene.materials) demands.push_back(demandOf(m));
  double all = 0, glossy = 0, weight = 0;
  std::array<double, kSizes.size()> shown{};
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Vec3d n = scene.scaledNormal(t);
    const double area = std::sqrt(dot(n, n));
    const Demand& demand = demands[scene.triangles[t].material];
    all += area;
    if (!demand.glossy) continue;
    glossy += area;
    weight += area * demand.reflects;
    for (std::size_t i = 0; i < kSizes.size(); ++i)
      if (demand.sharpness <= static_cast<double>(cellSharpness(kSizes[i]))) shown[i] += area * demand.reflects;
  }
  if (!(weight > 0)) return {kSizes.front(), 0, 1};
  std::size_t i = 0;
  while (i + 1 < kSizes.size() && shown[i] < kEnough * weight) ++i;
  return {kSizes[i], glossy / all, shown[i] / weight};
}

}  // namespace lucarne
