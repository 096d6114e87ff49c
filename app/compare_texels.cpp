#include "app/map_difference.h"
#include "dlm/map_surface.h"

namespace lucarne {
namespace {

/// One side of a chart in one set of maps; absent sides and unlit ones are black.
class SideReader {
 public:
  SideReader(const LightMaps& maps, std::uint32_t chart, bool back) : maps_(maps) {
    const MapChart& c = maps.charts[chart];
    const std::uint32_t index = back ? c.backSide : c.frontSide;
    if (index != kNone) side_ = &maps.sides[index];
  }
  bool exists() const { return side_ != nullptr; }
  bool hasDirections() const { return exists() && !side_->directions.empty(); }

  void readIrradiance(std::uint64_t t, Rgbd& value, double& error) const {
    if (!exists() || !side_->lit) return;
    value = Rgbd(maps_.irradiance[side_->firstTexel + t]);
    error = static_cast<double>(maps_.relativeError[side_->firstTexel + t]);
  }
  /// By ψ: the first texel of its map, null where it has none.
  std::vector<const Rgb*> directionalMaps() const {
    std::vector<const Rgb*> first(static_cast<std::size_t>(maps_.directionCount), nullptr);
    for (const SideDirection& d : side_->directions) {
      if (d.stored()) first[d.psi] = &maps_.directional[d.first];
    }
    return first;
  }

 private:
  const LightMaps& maps_;
  const SideMaps* side_ = nullptr;
};

Rgbd at(const Rgb* map, std::uint64_t t) { return map == nullptr ? Rgbd{} : Rgbd(map[t]); }

void compareDirections(const SideReader& a, const SideReader& b, const std::vector<double>& areas,
                       MapDifference& difference) {
  const std::vector<const Rgb*> mapsA = a.directionalMaps(), mapsB = b.directionalMaps();
  for (std::size_t psi = 0; psi < mapsA.size(); ++psi) {
    if (mapsA[psi] == nullptr && mapsB[psi] == nullptr) continue;
    for (std::uint64_t t = 0; t < areas.size(); ++t) {
      if (areas[t] > 0) difference.addDirection(static_cast<int>(psi), areas[t], at(mapsA[psi], t), at(mapsB[psi], t));
    }
  }
}

}  // namespace

void compareTexels(const Dlm& a, const Dlm& b, MapDifference& difference) {
  const TexelAreas texelAreas(a);
  for (std::uint32_t chart = 0; chart < a.maps.charts.size(); ++chart) {
    const MapChart& c = a.maps.charts[chart];
    std::vector<double> areas(static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height));
    for (std::uint64_t t = 0; t < areas.size(); ++t) areas[t] = texelAreas.of(chart, t);
    for (const bool back : {false, true}) {
      const SideReader sideA(a.maps, chart, back), sideB(b.maps, chart, back);
      if (!sideA.exists() && !sideB.exists()) continue;
      for (std::uint64_t t = 0; t < areas.size(); ++t) {
        if (!(areas[t] > 0)) continue;
        MapSample s{areas[t], chart, back};
        sideA.readIrradiance(t, s.a, s.errorA);
        sideB.readIrradiance(t, s.b, s.errorB);
        if (difference.add(s)) difference.worst.texel = t;
      }
      if (difference.sameDirections() && sideA.hasDirections() && sideB.hasDirections()) {
        compareDirections(sideA, sideB, areas, difference);
      }
    }
  }
  if (difference.samples == 0) return;
  WorstPlace& worst = difference.worst;
  const auto width = static_cast<std::uint64_t>(a.maps.charts[worst.sample.chart].width);
  worst.position =
      surfaceAt(a, worst.sample.chart,
                {0.5 + static_cast<double>(worst.texel % width), 0.5 + static_cast<double>(worst.texel / width)});
}

}  // namespace lucarne
