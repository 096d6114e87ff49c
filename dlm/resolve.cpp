#include "dlm/resolve.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "dlm/direct_gather.h"
#include "dlm/side_resolver.h"
#include "tracer/transport/ledger.h"

namespace lucarne {
namespace {

bool anyNonZero(std::span<const std::int64_t> v) {
  return std::any_of(v.begin(), v.end(), [](std::int64_t x) { return x != 0; });
}

std::span<const std::int64_t> mapUnits(const Tallies& set, const TallySide& side, std::uint64_t rank) {
  return set.light().subspan((side.firstLight + rank * side.texelCount()) * kLightChannels,
                             side.texelCount() * kLightChannels);
}

std::span<const std::int64_t> statisticsOf(const Tallies& set, const TallySide& side) {
  return set.statistics().subspan(side.firstTexel * kStatisticsChannels, side.texelCount() * kStatisticsChannels);
}

/// The sets that have anything to say.
std::vector<const Tallies*> setsOf(const ResolveInput& in) {
  std::vector<const Tallies*> sets;
  if (in.photons > 0) sets.push_back(&in.tallies);
  if (in.samples > 0) sets.push_back(in.tallies.direct());
  return sets;
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
  const std::vector<const Tallies*> sets = setsOf(in);
  tbb::parallel_for(std::size_t{0}, stored.size(), [&](std::size_t s) {
    const TallySide& side = in.tallyLayout.sides[s];
    const auto any = [&](auto&& spanOf) {
      return std::any_of(sets.begin(), sets.end(), [&](const Tallies* set) { return anyNonZero(spanOf(*set)); });
    };
    if (!any([&](const Tallies& set) { return statisticsOf(set, side); })) return;
    for (std::uint64_t k = 0; k < in.tallyLayout.membersOf(side).mapCount(); ++k)
      stored[s].push_back(any([&](const Tallies& set) { return mapUnits(set, side, k); }));
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

/// What turns units into lx: those of photons over local area, those of gathered samples by themselves.
struct Scales {
  double photons = 0, direct = 0;
};

/// One side and what its maps are made with.
struct SideInput {
  const ResolveInput& in;
  const TallySide& side;
  const SideResolver& resolver;
  Scales scales;
  std::span<const double> area() const {
    return {in.layout.area.data() + in.layout.charts[side.chart].firstTexel, side.texelCount()};
  }
};

/// Of a sum of N independent photons: Var(Σx) ≈ (Σx² − (Σx)²/N)·N/(N − 1), luminance, lx². One photon tells nothing
/// about its spread; it is taken for one of many. `irradiance`: of the photons.
std::vector<double> photonVariances(const SideInput& s, const std::vector<Rgbd>& irradiance) {
  std::vector<double> squares = s.resolver.filterSquares(statisticsOf(s.in.tallies, s.side), 1);
  const double unitsToFraction = 1 / static_cast<double>(kFixedPointOne), n = static_cast<double>(s.in.photons);
  for (std::size_t t = 0; t < squares.size(); ++t) {
    const double e = luminance(irradiance[t]);
    // The scale turns units into lx; m2 holds squares of fractions in units, so one factor of 2^24 less.
    const double square = squares[t] * s.scales.photons * s.scales.photons / unitsToFraction;
    squares[t] = s.in.photons > 1 ? (square - e * e / n) * (n / (n - 1)) : square;
  }
  return squares;
}

/// Luminance of a texel's samples, all directions together, in units.
std::vector<double> gatheredUnits(const SideInput& s) {
  std::vector<double> sums(s.side.texelCount());
  for (std::uint64_t k = 0; k < s.in.tallyLayout.membersOf(s.side).mapCount(); ++k) {
    const auto units = mapUnits(*s.in.tallies.direct(), s.side, k);
    for (std::size_t t = 0; t < sums.size(); ++t) {
      const std::int64_t* p = units.data() + kLightChannels * t;
      sums[t] += luminance(Rgbd{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    }
  }
  return sums;
}

/// Of a texel's mean over N samples: (Σx²/N − mean²)/(N − 1), luminance, weighted as resolve.h weights the means. lx².
std::vector<double> directVariances(const SideInput& s) {
  const auto pairs = statisticsOf(*s.in.tallies.direct(), s.side);
  const double one = static_cast<double>(kFixedPointOne), n = static_cast<double>(s.in.samples);
  std::vector<double> terms = gatheredUnits(s);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const double mean = terms[t] / (n * one),
                 square = static_cast<double>(pairs[kStatisticsChannels * t + 1]) / (n * one);
    const double variance = s.in.samples > 1 ? std::max(0.0, square - mean * mean) / (n - 1) : square;
    terms[t] = s.area()[t] * s.area()[t] * variance;
  }
  std::vector<double> variances = s.resolver.filterSquares(terms);
  const double unit = s.scales.direct * n * one;
  for (double& v : variances) v *= unit * unit;
  return variances;
}

void fillStatistics(const SideInput& s, const std::vector<Rgbd>& photonIrradiance, const std::vector<Rgbd>& irradiance,
                    const SideMaps& out, LightMaps& maps) {
  std::vector<double> variances(irradiance.size());
  if (s.in.photons > 0) variances = photonVariances(s, photonIrradiance);
  if (s.in.samples > 0) {
    const std::vector<double> direct = directVariances(s);
    for (std::size_t t = 0; t < variances.size(); ++t) variances[t] = std::max(0.0, variances[t]) + direct[t];
  }
  const auto pairs = statisticsOf(s.in.tallies, s.side);
  for (std::size_t t = 0; t < irradiance.size(); ++t) {
    const double e = luminance(irradiance[t]);
    maps.relativeError[out.firstTexel + t] =
        e > 0 ? static_cast<float>(std::sqrt(std::max(0.0, variances[t])) / e) : 0.f;
    maps.photons[out.firstTexel + t] = static_cast<float>(pairs[kStatisticsChannels * t]);
  }
}

/// Irradiance of one set, lx; its maps by direction are added to `maps`.
std::vector<Rgbd> addSet(const SideInput& s, bool gathered, const SideMaps& out, LightMaps& maps) {
  const Tallies& set = gathered ? *s.in.tallies.direct() : s.in.tallies;
  const double scale = gathered ? s.scales.direct : s.scales.photons;
  std::vector<Rgbd> irradiance(s.side.texelCount());
  for (std::uint64_t k = 0; k < s.in.tallyLayout.membersOf(s.side).mapCount(); ++k) {
    const bool directional = !out.directions.empty();
    if (directional && !out.directions[k].stored()) continue;
    const auto units = mapUnits(set, s.side, k);
    const std::vector<Rgbd> values = gathered ? s.resolver.filterMeans(units, s.area()) : s.resolver.filterRgb(units);
    for (std::size_t t = 0; t < values.size(); ++t) {
      const Rgbd lux = values[t] * scale;
      irradiance[t] += lux;
      if (directional) maps.directional[out.directions[k].first + t] += Rgb(lux);
    }
  }
  return irradiance;
}

void resolveSide(const ResolveInput& in, const Kernel& kernel, const Scales& scales, std::size_t index,
                 LightMaps& maps) {
  const SideMaps& out = maps.sides[index];
  if (!out.lit) return;
  const TallySide& side = in.tallyLayout.sides[index];
  const std::span<const double> area(in.layout.area.data() + in.layout.charts[side.chart].firstTexel,
                                     side.texelCount());
  const SideResolver resolver(side.width, side.height, area, kernel);
  const SideInput s{in, side, resolver, scales};
  const std::vector<Rgbd> photons = in.photons > 0 ? addSet(s, false, out, maps) : std::vector<Rgbd>(side.texelCount());
  std::vector<Rgbd> irradiance = photons;
  if (in.samples > 0) {
    const std::vector<Rgbd> direct = addSet(s, true, out, maps);
    for (std::size_t t = 0; t < irradiance.size(); ++t) irradiance[t] += direct[t];
  }
  for (std::size_t t = 0; t < irradiance.size(); ++t) maps.irradiance[out.firstTexel + t] = Rgb(irradiance[t]);
  fillStatistics(s, photons, irradiance, out, maps);
}

}  // namespace

LightMaps resolve(const ResolveInput& in, const KernelOptions& options) {
  LightMaps maps;
  maps.directionCount = in.directionCount;
  maps.charts = describeCharts(in);
  planMaps(in, maps);
  const Kernel kernel = makeKernel(options);
  const double metres = in.scene.frame.scale;
  Scales scales;
  if (in.photons > 0)
    scales.photons =
        in.emittedFlux / static_cast<double>(in.photons) / static_cast<double>(kFixedPointOne) / (metres * metres);
  if (in.samples > 0)
    scales.direct = directUnit(in.emittedFlux, in.layout, metres) / static_cast<double>(in.samples) /
                    static_cast<double>(kFixedPointOne);
  tbb::parallel_for(std::size_t{0}, maps.sides.size(),
                    [&](std::size_t s) { resolveSide(in, kernel, scales, s, maps); });
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
