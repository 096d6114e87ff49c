#include "player/map_tables.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/error.h"
#include "dlm/mean_direction.h"

namespace lucarne {
namespace {

/// Members in the shaders' order: stored ones, then empty ones.
std::vector<std::uint16_t> orderedMembers(const SideMaps& side) {
  std::vector<std::uint16_t> members;
  for (const bool stored : {true, false}) {
    for (const SideDirection& d : side.directions) {
      if (d.stored() == stored) members.push_back(d.psi);
    }
  }
  return members;
}

int storedCount(const SideMaps& side) {
  return static_cast<int>(
      std::count_if(side.directions.begin(), side.directions.end(), [](const auto& d) { return d.stored(); }));
}

/// Cells of one horizon after another; axis-aligned scenes have few different ones.
class HorizonCache {
 public:
  HorizonCache(const DirectionSet& set, bool means) : set_(set), means_(means) {}

  LobeCell cell(Vec3f n, int psi) {
    std::vector<LobeCell>& cells = byNormal_[{n.x, n.y, n.z}];
    if (cells.empty()) {
      const Vec3d horizon = normalize(Vec3d(n));
      for (int i = 0; i < set_.count(); ++i)
        cells.push_back(means_ ? meanCell(set_, i, horizon) : lobeCell(set_, i, horizon));
    }
    return cells[static_cast<std::size_t>(psi)];
  }

 private:
  const DirectionSet& set_;
  bool means_;
  std::map<std::tuple<float, float, float>, std::vector<LobeCell>> byNormal_;
};

void checkSide(const LightMaps& maps, const SideMaps& side, std::uint64_t texels) {
  LUCARNE_CHECK_LT(side.chart, maps.charts.size());
  if (!side.lit) return;
  LUCARNE_CHECK_LT(0, side.width);
  LUCARNE_CHECK_LT(0, side.height);
  LUCARNE_CHECK_LE(side.firstTexel, maps.irradiance.size());
  LUCARNE_CHECK_LE(side.texelCount(), maps.irradiance.size() - side.firstTexel);
  for (const SideDirection& d : side.directions) {
    LUCARNE_CHECK_LT(static_cast<int>(d.psi), maps.directionCount);
    if (!d.stored()) continue;
    LUCARNE_CHECK_LE(d.first, texels);
    LUCARNE_CHECK_LE(side.texelCount(), texels - d.first);
  }
}

/// Places of the lit sides' rectangles; `layersOf` 0 leaves a side out.
template <class LayersOf>
LayeredPacking packSides(const LightMaps& maps, int maxLayers, const TextureLimits& limits, const LayersOf& layersOf) {
  std::vector<LayeredRect> rects;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < maps.sides.size(); ++i) {
    const SideMaps& side = maps.sides[i];
    const int layers = side.lit ? layersOf(side) : 0;
    if (layers == 0) continue;
    const int strips = (layers + maxLayers - 1) / maxLayers;
    if (strips > limits.size / side.width)
      throw Error(ExitCode::outOfResource, "a chart has more directions than OpenGL can hold");
    rects.push_back({side.width * strips, side.height, std::min(layers, maxLayers)});
    owner.push_back(i);
  }
  LayeredPacking packing = packLayered(rects, limits);
  std::vector<LayeredPlace> places(maps.sides.size());
  for (std::size_t k = 0; k < owner.size(); ++k) places[owner[k]] = packing.places[k];
  packing.places = std::move(places);
  return packing;
}

GpuSide sideRecord(const SideMaps& side, LayeredPlace maps, LayeredPlace irradiance) {
  GpuSide r;
  r.flags = GpuSide::kPresent;
  if (!side.lit) return r;
  r.flags |= GpuSide::kLit | (side.directions.empty() ? 0 : GpuSide::kDirections);
  r.mapX = static_cast<float>(maps.x);
  r.mapY = static_cast<float>(maps.y);
  r.width = static_cast<float>(side.width);
  r.height = static_cast<float>(side.height);
  r.irradianceX = static_cast<float>(irradiance.x);
  r.irradianceY = static_cast<float>(irradiance.y);
  r.irradianceLayer = static_cast<std::uint32_t>(irradiance.layer);
  r.firstLayer = static_cast<std::uint32_t>(maps.layer);
  r.stored = static_cast<std::uint32_t>(storedCount(side));
  r.members = static_cast<std::uint32_t>(side.directions.size());
  return r;
}

void markMembers(const SideMaps& side, GpuMemberBits* words, int wordCount) {
  for (const SideDirection& d : side.directions) {
    GpuMemberBits& word = words[d.psi / 32];
    (d.stored() ? word.stored : word.empty) |= 1u << (d.psi % 32);
  }
  std::uint32_t stored = 0, empty = 0;
  for (int i = 0; i < wordCount; ++i) {
    words[i].storedBefore = stored;
    words[i].emptyBefore = empty;
    stored += static_cast<std::uint32_t>(__builtin_popcount(words[i].stored));
    empty += static_cast<std::uint32_t>(__builtin_popcount(words[i].empty));
  }
}

}  // namespace

std::uint64_t mapTextureBytes(const LightMaps& maps, LightMapFormat format, const TextureLimits& limits) {
  const auto one = [](const SideMaps&) { return 1; };
  const std::uint64_t mapTexel = bytesPerTexel(format) + (maps.hasMeans() ? kMeanBytes : 0);
  return packSides(maps, limits.layers, limits, storedCount).texels() * mapTexel +
         packSides(maps, limits.layers, limits, one).texels() * kEvenBytesPerTexel;
}

MapTables layOutMaps(const LightMaps& maps, const DirectionSet& set, const TextureLimits& limits, std::uint64_t texels) {
  LUCARNE_CHECK_EQ(set.count(), maps.directionCount);
  for (const SideMaps& side : maps.sides) checkSide(maps, side, texels);
  MapTables t;
  t.layersPerStrip = limits.layers;
  t.directional = packSides(maps, limits.layers, limits, storedCount);
  t.irradiance = packSides(maps, limits.layers, limits, [](const SideMaps&) { return 1; });
  t.wordsPerSide = (maps.directionCount + 31) / 32;
  t.memberBits.resize((maps.sides.size() + 1) * static_cast<std::size_t>(t.wordsPerSide));
  t.sides.emplace_back();

  if (maps.hasMeans()) LUCARNE_CHECK_EQ(maps.meanDirections.size(), maps.directional.size());
  HorizonCache horizons(set, maps.hasMeans());
  for (std::size_t i = 0; i < maps.sides.size(); ++i) {
    const SideMaps& side = maps.sides[i];
    const MapChart& chart = maps.charts[side.chart];
    GpuSide record = sideRecord(side, t.directional.places[i], t.irradiance.places[i]);
    record.firstCell = static_cast<std::uint32_t>(t.cells.size());
    t.sides.push_back(record);
    if (!side.lit) continue;
    for (const std::uint16_t psi : orderedMembers(side)) {
      if (maps.hasMeans()) {
        const Vec3f d(set.direction(psi));
        t.directions.push_back({d.x, d.y, d.z, 0});
      }
      if (needsCellTable(chart)) {
        t.cells.push_back({0, 0, 0, static_cast<float>(psi)});
      } else {
        const LobeCell c = horizons.cell(side.back ? -chart.normal : chart.normal, psi);
        t.cells.push_back({c.direction.x, c.direction.y, c.direction.z, c.cosIntegral});
      }
    }
    markMembers(side, &t.memberBits[(i + 1) * static_cast<std::size_t>(t.wordsPerSide)], t.wordsPerSide);
  }
  return t;
}

}  // namespace lucarne
