// Light maps laid out for the shaders, still in memory: where each side's texels go, and its list of cells.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/direction_set.h"
#include "dlm/light_maps.h"
#include "player/cell_tables.h"
#include "player/gpu_records.h"
#include "player/layered_pack.h"
#include "player/render_options.h"

namespace lucarne {

struct MapTables {
  std::vector<GpuSide> sides;  // [0] absorbs
  // Of planar charts vec4(mean direction, C), where the maps have means those of MeanCell; of the others ψ in the last
  // component, the rest unused.
  std::vector<LobeTexel> cells;
  std::vector<LobeTexel> directions;  // by cell, where the maps have means: vec4(ψ, unused)
  int wordsPerSide = 1;                   // ⌈|Ω|/32⌉
  std::vector<GpuMemberBits> memberBits;  // [record · wordsPerSide + ψ/32]
  int layersPerStrip = 1;
  LayeredPacking directional, irradiance;
};

/// A chart whose cells depend on the fragment's normal.
inline bool needsCellTable(const MapChart& chart) { return !chart.planar || chart.smooth; }

/// Of irradiance and statistics.
inline constexpr std::uint64_t kEvenBytesPerTexel = 16 + 8;
/// Bytes of textures that the directional maps, their mean directions, the irradiance and the statistics take.
std::uint64_t mapTextureBytes(const LightMaps& maps, LightMapFormat format, const TextureLimits& limits);
constexpr std::uint64_t bytesPerTexel(LightMapFormat format) {
  return format == LightMapFormat::float32 ? 16 : format == LightMapFormat::half ? 8 : 4;
}

/// Where the stored map of that rank of a side lies whose first one is at `first`: one a layer, then to the right of itself.
constexpr LayeredPlace placeOf(LayeredPlace first, int layersPerStrip, int rank, int width) {
  return {first.x + rank / layersPerStrip * width, first.y, first.layer + rank % layersPerStrip};
}
inline LayeredPlace placeOf(const MapTables& tables, std::size_t side, int rank, int width) {
  return placeOf(tables.directional.places[side], tables.layersPerStrip, rank, width);
}

/// Checks the indices of `maps` against each other (std::logic_error: a reader let them through). `texels`: of the
/// directional maps, in memory or not.
MapTables layOutMaps(const LightMaps& maps, const DirectionSet& set, const TextureLimits& limits, std::uint64_t texels);
inline MapTables layOutMaps(const LightMaps& maps, const DirectionSet& set, const TextureLimits& limits) {
  return layOutMaps(maps, set, limits, maps.directional.size());
}

}  // namespace lucarne
