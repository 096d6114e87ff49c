#include "player/coarser_directions.h"

#include <map>

#include "base/error.h"

namespace lucarne {
namespace {

/// One side's maps, appended to `directional`.
void gather(const LightMaps& maps, SideMaps& side, const std::vector<std::uint16_t>& coarseOf,
            std::vector<Rgb>& directional) {
  const auto texels = static_cast<std::size_t>(side.texelCount());
  std::map<std::uint16_t, std::uint64_t> firsts;  // by coarse ψ
  for (const SideDirection& d : side.directions) {
    std::uint64_t& first = firsts.try_emplace(coarseOf[d.psi], SideDirection::kEmptyMap).first->second;
    if (!d.stored()) continue;
    if (first == SideDirection::kEmptyMap) {
      first = directional.size();
      directional.resize(directional.size() + texels);
    }
    for (std::size_t i = 0; i < texels; ++i) directional[first + i] += maps.directional[d.first + i];
  }
  side.directions.clear();
  for (const auto& [psi, first] : firsts) side.directions.push_back({psi, first});
}

}  // namespace

LightMaps withFewerDirections(const LightMaps& maps, int directionCount) {
  LUCARNE_CHECK_LT(directionCount, maps.directionCount);
  const DirectionSet fine(maps.directionCount), coarse(directionCount);
  std::vector<std::uint16_t> coarseOf;
  for (const Vec3d& d : fine.directions()) coarseOf.push_back(static_cast<std::uint16_t>(coarse.nearest(Vec3f(d))));
  LightMaps out;
  out.directionCount = directionCount;
  out.charts = maps.charts;
  out.sides = maps.sides;
  out.atlasWidth = maps.atlasWidth;
  out.atlasHeight = maps.atlasHeight;
  out.irradiance = maps.irradiance;
  out.standardError = maps.standardError;
  out.relativeError = maps.relativeError;
  out.photons = maps.photons;
  for (SideMaps& side : out.sides) {
    if (side.lit) gather(maps, side, coarseOf, out.directional);
  }
  return out;
}

}  // namespace lucarne
