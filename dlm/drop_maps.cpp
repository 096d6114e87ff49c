#include "dlm/drop_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"

namespace lucarne {
namespace {

/// 1 over what a texel's loss is relative to; 0 where the whole side is black.
std::vector<double> inverseReference(const LightMaps& maps, const SideMaps& side) {
  std::vector<double> light;
  for (std::uint64_t t = 0; t < side.texelCount(); ++t)
    light.push_back(static_cast<double>(luminance(maps.irradiance[side.firstTexel + t])));
  const double mean = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
  for (double& e : light) e = std::max(e, mean) > 0 ? 1 / std::max(e, mean) : 0;
  return light;
}

/// Share of its texel's reference that a map holds.
double shareAt(const LightMaps& maps, std::uint64_t first, std::span<const double> inverse, std::size_t t) {
  return static_cast<double>(luminance(maps.directional[first + t])) * inverse[t];
}

struct SideDrop {
  std::vector<std::size_t> members;  // into SideMaps::directions
  double lost = 0;
};

/// The faintest maps, as long as no texel loses more than the bound.
SideDrop chooseMaps(const LightMaps& maps, const SideMaps& side, double bound) {
  const std::vector<double> inverse = inverseReference(maps, side);
  std::vector<std::pair<double, std::size_t>> faintest;
  for (std::size_t k = 0; k < side.directions.size(); ++k) {
    if (!side.directions[k].stored()) continue;
    double most = 0;
    for (std::size_t t = 0; t < inverse.size() && most <= bound; ++t)
      most = std::max(most, shareAt(maps, side.directions[k].first, inverse, t));
    if (most <= bound) faintest.emplace_back(most, k);
  }
  std::sort(faintest.begin(), faintest.end());
  SideDrop drop;
  std::vector<double> lost(inverse.size(), 0), with(inverse.size());
  for (const auto& [most, k] : faintest) {
    double worst = 0;
    for (std::size_t t = 0; t < lost.size(); ++t) {
      with[t] = lost[t] + shareAt(maps, side.directions[k].first, inverse, t);
      worst = std::max(worst, with[t]);
    }
    if (worst > bound) continue;
    std::swap(lost, with);
    drop.members.push_back(k);
    drop.lost = worst;
  }
  return drop;
}

/// Takes away the colour of maps that have next to none. Returns how many texels they have.
std::uint64_t neutralise(LightMaps& maps, const SideMaps& side, double bound) {
  const std::vector<double> inverse = inverseReference(maps, side);
  std::uint64_t texels = 0;
  for (const SideDirection& d : side.directions) {
    if (!d.stored()) continue;
    Rgb* const map = maps.directional.data() + d.first;
    bool neutral = true;
    for (std::size_t t = 0; t < inverse.size() && neutral; ++t) {
      const Rgb off = map[t] - Rgb(luminance(map[t]));
      const float most = std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
      neutral = static_cast<double>(most) * inverse[t] <= bound;
    }
    if (!neutral) continue;
    for (std::size_t t = 0; t < inverse.size(); ++t) map[t] = Rgb(luminance(map[t]));
    texels += inverse.size();
  }
  return texels;
}

/// Moves the maps that stay together. They lie in the order of sides and members.
void closeGaps(LightMaps& maps) {
  std::uint64_t next = 0;
  for (SideMaps& side : maps.sides) {
    for (SideDirection& d : side.directions) {
      if (!d.stored()) continue;
      LUCARNE_CHECK_LE(next, d.first);
      const auto from = maps.directional.begin() + static_cast<std::ptrdiff_t>(d.first);
      std::copy(from, from + static_cast<std::ptrdiff_t>(side.texelCount()),
                maps.directional.begin() + static_cast<std::ptrdiff_t>(next));
      if (maps.hasMeans()) {
        const auto mean = maps.meanDirections.begin() + static_cast<std::ptrdiff_t>(d.first);
        std::copy(mean, mean + static_cast<std::ptrdiff_t>(side.texelCount()),
                  maps.meanDirections.begin() + static_cast<std::ptrdiff_t>(next));
      }
      d.first = next;
      next += side.texelCount();
    }
  }
  maps.directional.resize(next);
  if (maps.hasMeans()) maps.meanDirections.resize(next);
}

}  // namespace

DroppedMaps dropFaintMaps(LightMaps& maps, double bound) {
  LUCARNE_CHECK_LE(0.0, bound);
  DroppedMaps dropped;
  dropped.storedTexels = maps.directional.size();
  if (bound <= 0) return dropped;
  std::vector<SideDrop> drops(maps.sides.size());
  tbb::parallel_for(std::size_t{0}, drops.size(), [&](std::size_t s) {
    if (maps.sides[s].lit) drops[s] = chooseMaps(maps, maps.sides[s], bound);
  });
  for (std::size_t s = 0; s < drops.size(); ++s) {
    for (const std::size_t k : drops[s].members) maps.sides[s].directions[k].first = SideDirection::kEmptyMap;
    dropped.maps += drops[s].members.size();
    dropped.texels += drops[s].members.size() * maps.sides[s].texelCount();
    dropped.lost = std::max(dropped.lost, drops[s].lost);
  }
  closeGaps(maps);
  std::vector<std::uint64_t> neutral(maps.sides.size());
  tbb::parallel_for(std::size_t{0}, neutral.size(), [&](std::size_t s) {
    if (maps.sides[s].lit) neutral[s] = neutralise(maps, maps.sides[s], bound);
  });
  dropped.neutralTexels = std::accumulate(neutral.begin(), neutral.end(), std::uint64_t{0});
  return dropped;
}

}  // namespace lucarne
