#include "player/coarser_directions.h"

#include <map>

#include "base/error.h"
#include "dlm/mean_direction.h"

namespace lucarne {
namespace {

/// One side's maps, appended to those of `out`; its mean directions stay sums, weighed by luminance.
void gather(const LightMaps& maps, SideMaps& side, const std::vector<std::uint16_t>& coarseOf, LightMaps& out) {
  std::vector<Rgb>& directional = out.directional;
  const auto texels = static_cast<std::size_t>(side.texelCount());
  std::map<std::uint16_t, std::uint64_t> firsts;  // by coarse ψ
  for (const SideDirection& d : side.directions) {
    std::uint64_t& first = firsts.try_emplace(coarseOf[d.psi], SideDirection::kEmptyMap).first->second;
    if (!d.stored()) continue;
    if (first == SideDirection::kEmptyMap) {
      first = directional.size();
      directional.resize(directional.size() + texels);
      if (maps.hasMeans()) out.meanDirections.resize(directional.size());
    }
    for (std::size_t i = 0; i < texels; ++i) directional[first + i] += maps.directional[d.first + i];
    for (std::size_t i = 0; maps.hasMeans() && i < texels; ++i)
      out.meanDirections[first + i] += maps.meanDirections[d.first + i] * luminance(maps.directional[d.first + i]);
  }
  side.directions.clear();
  for (const auto& [psi, first] : firsts) side.directions.push_back({psi, first});
}

void divideByLight(LightMaps& maps, const SideMaps& side, const SideDirection& d, Vec3f psi) {
  for (std::uint64_t i = d.first; i < d.first + side.texelCount(); ++i) {
    const float light = luminance(maps.directional[i]);
    maps.meanDirections[i] = light > 0 ? boundedMean(maps.meanDirections[i] / light) : psi;
  }
}

}  // namespace

LightMaps withFewerDirections(const LightMaps& maps, int directionCount) {
  LUCARNE_CHECK_LT(directionCount, maps.directionCount);
  const DirectionSet fine(maps.directionCount), coarse(directionCount);
  std::vector<std::uint16_t> coarseOf;
  for (const Vec3d& d : fine.directions()) coarseOf.push_back(static_cast<std::uint16_t>(coarse.nearest(Vec3f(d))));
  LightMaps out;
  out.directionCount = directionCount;  // and the filter is `nearest`: shares of the fine set go into coarse cells
  out.charts = maps.charts;
  out.sides = maps.sides;
  out.atlasWidth = maps.atlasWidth;
  out.atlasHeight = maps.atlasHeight;
  out.irradiance = maps.irradiance;
  out.standardError = maps.standardError;
  out.relativeError = maps.relativeError;
  out.photons = maps.photons;
  for (SideMaps& side : out.sides) {
    if (side.lit) gather(maps, side, coarseOf, out);
  }
  if (!maps.hasMeans()) return out;
  for (const SideMaps& side : out.sides) {
    for (const SideDirection& d : side.directions) {
      if (d.stored()) divideByLight(out, side, d, Vec3f(coarse.direction(d.psi)));
    }
  }
  return out;
}

}  // namespace lucarne
