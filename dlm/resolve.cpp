#include "dlm/resolve.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "dlm/side_resolver.h"
#include "tracer/transport/ledger.h"

namespace lucarne {
namespace {

bool anyNonZero(std::span<const std::int64_t> v) {
  return std::any_of(v.begin(), v.end(), [](std::int64_t x) { return x != 0; });
}

std::span<const std::int64_t> mapUnits(const ResolveInput& in, const TallySide& side, std::uint64_t rank) {
  return in.tallies.light().subspan((side.firstLight + rank * side.texelCount()) * kLightChannels,
                                    side.texelCount() * kLightChannels);
}

std::span<const std::int64_t> statisticsOf(const ResolveInput& in, const TallySide& side) {
  return in.tallies.statistics().subspan(side.firstTexel * kStatisticsChannels, side.texelCount() * kStatisticsChannels);
}

bool isPlanar(const Scene& scene, const Chart& chart) {
  constexpr double kCosTolerance = 1 - 5e-7;  // a milliradian
  return !chart.smooth && std::all_of(chart.triangles.begin(), chart.triangles.end(), [&](std::uint32_t t) {
    return dot(normalize(scene.scaledNormal(t)), chart.normal) > kCosTolerance;
  });
}

std::vector<MapChart> describeCharts(const ResolveInput& in) {
  std::vector<MapChart> charts;
  for (std::size_t c = 0; c < in.charts.charts.size(); ++c) {
    const Chart& chart = in.charts.charts[c];
    const ChartLayout& layout = in.layout.charts[c];
    MapChart m;
    m.material = chart.material;
    m.smooth = chart.smooth;
    m.planar = isPlanar(in.scene, chart);
    m.normal = Vec3f(chart.normal);
    m.texelSize = in.scene.frame.scale / std::sqrt(layout.texelsPerLocal.x * layout.texelsPerLocal.y);
    m.width = layout.width;
    m.height = layout.height;
    m.frontSide = in.tallyLayout.frontSide[c];
    m.backSide = in.tallyLayout.backSide[c];
    charts.push_back(m);
  }
  return charts;
}

/// Which sides and maps have any light, and where they go in the arrays.
void planMaps(const ResolveInput& in, LightMaps& maps) {
  std::vector<std::vector<std::uint8_t>> stored(in.tallyLayout.sides.size());
  tbb::parallel_for(std::size_t{0}, stored.size(), [&](std::size_t s) {
    const TallySide& side = in.tallyLayout.sides[s];
    if (in.photons == 0 || !anyNonZero(statisticsOf(in, side))) return;
    for (std::uint64_t k = 0; k < in.tallyLayout.membersOf(side).mapCount(); ++k)
      stored[s].push_back(anyNonZero(mapUnits(in, side, k)));
  });
  std::uint64_t texels = 0, entries = 0;
  for (std::size_t s = 0; s < stored.size(); ++s) {
    const TallySide& side = in.tallyLayout.sides[s];
    SideMaps m{side.chart, side.back, !stored[s].empty(), side.width, side.height, texels, {}};
    if (m.lit) {
      texels += side.texelCount();
      const auto& members = in.tallyLayout.membersOf(side).members;
      for (std::size_t k = 0; k < members.size(); ++k) {
        m.directions.push_back({members[k], stored[s][k] ? entries : SideDirection::kEmptyMap});
        if (stored[s][k]) entries += side.texelCount();
      }
    }
    maps.sides.push_back(std::move(m));
  }
  maps.irradiance.resize(texels);
  maps.relativeError.resize(texels);
  maps.photons.resize(texels);
  maps.directional.resize(entries);
}

/// Standard error of a sum of N independent photons: Var(Σx) ≈ (Σx² − (Σx)²/N)·N/(N − 1), luminance, in the same units as
/// E. One photon tells nothing about its spread; it is taken for one of many.
void fillStatistics(const ResolveInput& in, const TallySide& side, const SideResolver& resolver, double scale,
                    const std::vector<Rgbd>& irradiance, const SideMaps& out, LightMaps& maps) {
  const auto pairs = statisticsOf(in, side);
  const std::vector<double> squares = resolver.filterSquares(pairs, 1);
  const double unitsToFraction = 1 / static_cast<double>(kFixedPointOne), n = static_cast<double>(in.photons);
  for (std::size_t t = 0; t < irradiance.size(); ++t) {
    const double e = luminance(irradiance[t]);
    // `scale` turns units into lx; m2 holds squares of fractions in units, so one factor of 2^24 less.
    const double square = squares[t] * scale * scale / unitsToFraction;
    const double variance = in.photons > 1 ? (square - e * e / n) * (n / (n - 1)) : square;
    maps.relativeError[out.firstTexel + t] = e > 0 ? static_cast<float>(std::sqrt(std::max(0.0, variance)) / e) : 0.f;
    maps.photons[out.firstTexel + t] = static_cast<float>(pairs[kStatisticsChannels * t]);
  }
}

void resolveSide(const ResolveInput& in, const Kernel& kernel, double scale, std::size_t s, LightMaps& maps) {
  const SideMaps& out = maps.sides[s];
  if (!out.lit) return;
  const TallySide& side = in.tallyLayout.sides[s];
  const ChartLayout& chart = in.layout.charts[side.chart];
  const std::span<const double> area(in.layout.area.data() + chart.firstTexel, side.texelCount());
  const SideResolver resolver(side.width, side.height, area, kernel);
  std::vector<Rgbd> irradiance(side.texelCount());
  for (std::uint64_t k = 0; k < in.tallyLayout.membersOf(side).mapCount(); ++k) {
    const bool directional = !out.directions.empty();
    if (directional && !out.directions[k].stored()) continue;
    const std::vector<Rgbd> values = resolver.filterRgb(mapUnits(in, side, k));
    for (std::size_t t = 0; t < values.size(); ++t) {
      const Rgbd lux = values[t] * scale;
      irradiance[t] += lux;
      if (directional) maps.directional[out.directions[k].first + t] = Rgb(lux);
    }
  }
  for (std::size_t t = 0; t < irradiance.size(); ++t) maps.irradiance[out.firstTexel + t] = Rgb(irradiance[t]);
  fillStatistics(in, side, resolver, scale, irradiance, out, maps);
}

}  // namespace

LightMaps resolve(const ResolveInput& in, const KernelOptions& options) {
  LightMaps maps;
  maps.directionCount = in.directionCount;
  maps.charts = describeCharts(in);
  planMaps(in, maps);
  const Kernel kernel = makeKernel(options);
  const double metres = in.scene.frame.scale;
  // Units over local area to lux.
  const double scale = in.photons == 0 ? 0
                                       : in.emittedFlux / static_cast<double>(in.photons) /
                                             static_cast<double>(kFixedPointOne) / (metres * metres);
  tbb::parallel_for(std::size_t{0}, maps.sides.size(), [&](std::size_t s) { resolveSide(in, kernel, scale, s, maps); });
  return maps;
}

double estimatedRelativeError(const LightMaps& maps, const TexelLayout& layout) {
  double error = 0, flux = 0;
  for (const SideMaps& side : maps.sides) {
    if (!side.lit) continue;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      const double f = layout.area[layout.charts[side.chart].firstTexel + t] *
                       static_cast<double>(luminance(maps.irradiance[side.firstTexel + t]));
      flux += f;
      error += f * static_cast<double>(maps.relativeError[side.firstTexel + t]);
    }
  }
  return flux > 0 ? error / flux : 0;
}

}  // namespace lucarne
