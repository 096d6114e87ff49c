#include "dlm/resolve_means.h"

#include "dlm/mean_direction.h"

namespace lucarne {
namespace {

/// Σ k·moment over Σ k·area of all sets, lx.
std::vector<Vec3d> filteredMoments(const SideInput& s, std::uint64_t rank) {
  std::vector<Vec3d> sum(s.side.texelCount());
  const auto add = [&](const std::vector<Rgbd>& values, double scale) {
    for (std::size_t t = 0; t < sum.size(); ++t) sum[t] += values[t] * scale;
  };
  if (s.in.photons > 0) add(s.resolver.filterRgb(momentUnits(s.in.tallies, s.side, rank)), s.scales.photons);
  if (s.in.samples > 0)
    add(s.resolver.filterMeans(momentUnits(*s.in.tallies.direct(), s.side, rank), s.area()), s.scales.direct);
  return sum;
}

Vec3f meanAround(std::span<const Rgb> light, std::span<const Vec3f> means, const SideMaps& side, int x, int y) {
  Vec3f sum{};
  float count = 0;
  for (int v = std::max(0, y - 1); v <= std::min(side.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(side.width - 1, x + 1); ++u) {
      const auto n = static_cast<std::size_t>(v) * static_cast<std::size_t>(side.width) + static_cast<std::size_t>(u);
      if (!(luminance(light[n]) > 0)) continue;
      sum += means[n];
      ++count;
    }
  }
  return count > 0 ? sum / count : Vec3f{};
}

}  // namespace

void resolveMeans(const SideInput& s, std::span<const Vec3d> directions, const SideMaps& side, LightMaps& maps) {
  for (std::size_t k = 0; k < side.directions.size(); ++k) {
    const SideDirection& d = side.directions[k];
    if (!d.stored()) continue;
    const std::span<const Rgb> light(maps.directional.data() + d.first, side.texelCount());
    const std::span<Vec3f> means(maps.meanDirections.data() + d.first, side.texelCount());
    const std::vector<Vec3d> moments = filteredMoments(s, k);
    for (std::size_t t = 0; t < means.size(); ++t) {
      const double l = luminance(Rgbd(light[t]));
      if (l > 0) means[t] = boundedMean(Vec3f(moments[t] * (2 / l) - Vec3d(1)));
    }
    std::size_t t = 0;
    for (int y = 0; y < side.height; ++y) {
      for (int x = 0; x < side.width; ++x, ++t) {
        if (luminance(light[t]) > 0) continue;
        const Vec3f around = meanAround(light, means, side, x, y);
        means[t] = dot(around, around) > 0 ? around : Vec3f(directions[d.psi]);
      }
    }
  }
}

}  // namespace lucarne
