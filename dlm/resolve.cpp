#include "dlm/resolve.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "dlm/direct_gather.h"
#include "dlm/direction_set_cells.h"
#include "dlm/kernel_levels.h"
#include "dlm/resolve_means.h"
#include "dlm/side_errors.h"

namespace lucarne {
namespace {

bool anyNonZero(std::span<const std::int64_t> v) {
  return std::any_of(v.begin(), v.end(), [](std::int64_t x) { return x != 0; });
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
  maps.standardError.resize(texels);
  maps.relativeError.resize(texels);
  maps.photons.resize(texels);
  maps.directional.resize(entries);
  if (in.tallyLayout.momentEntries > 0) maps.meanDirections.resize(entries);
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

/// lx of a unit.
Scales scalesOf(const ResolveInput& in) {
  const double metres = in.scene.frame.scale;
  Scales scales;
  if (in.photons > 0)
    scales.photons =
        in.emittedFlux / static_cast<double>(in.photons) / static_cast<double>(kFixedPointOne) / (metres * metres);
  if (in.samples > 0)
    scales.direct = directUnit(in.emittedFlux, in.layout, metres) / static_cast<double>(in.samples) /
                    static_cast<double>(kFixedPointOne);
  return scales;
}

/// All that is the same for every side.
struct ResolveRun {
  const ResolveInput& in;
  std::vector<Kernel> kernels;
  Scales scales;
  LightMaps& maps;
  std::vector<SideErrors> errors;   // by side
  std::vector<KernelBias> biases;   // by side
  std::vector<Vec3d> directions = {};  // Ω; empty where there are no moments
  const Kernel& usual() const { return kernels[std::min<std::size_t>(1, kernels.size() - 1)]; }
};

/// Tries every kernel at every texel.
KernelBias chooseKernels(const ResolveRun& run, const TallySide& side, const SideContacts& contacts,
                         std::span<const double> area, LevelResolver& resolver) {
  std::vector<LevelEstimate> estimates;
  std::vector<std::vector<double>> own;
  std::vector<bool> hasSurface;
  for (std::size_t t = 0; t < area.size(); ++t) hasSurface.push_back(area[t] * contacts.share(t) > 0 && !contacts.hidden(t));
  for (const Kernel& kernel : run.kernels) {
    const LevelResolver one(side.width, side.height, area, std::span(&kernel, 1), contacts);
    estimates.push_back(estimateOf({run.in, side, one, kernel, contacts, run.scales}));
    own.emplace_back(area.begin(), area.end());
    for (std::size_t t = 0; t < area.size(); ++t) own.back()[t] *= contacts.share(t) * one.level(0).inverseArea()[t];
  }
  LevelChoice choice = chooseLevels(side.width, side.height, estimates, own, hasSurface);
  KernelBias bias;
  for (std::size_t t = 0; t < area.size(); ++t) {
    if (!hasSurface[t]) continue;
    bias.flux += area[t] * estimates[choice.level[t]].value[t];
    bias.biased += area[t] * std::sqrt(choice.biasSquared[t]);
  }
  resolver.choose(std::move(choice.level));
  return bias;
}

std::span<const double> areaOf(const ResolveInput& in, const TallySide& side) {
  return {in.layout.area.data() + in.layout.charts[side.chart].firstTexel, side.texelCount()};
}

void resolveSide(ResolveRun& run, std::size_t index) {
  const ResolveInput& in = run.in;
  LightMaps& maps = run.maps;
  const SideMaps& out = maps.sides[index];
  if (!out.lit) return;
  const TallySide& side = in.tallyLayout.sides[index];
  const std::span<const double> area = areaOf(in, side);
  const SideContacts none;
  const SideContacts& contacts = in.contacts.empty() ? none : in.contacts[index];
  LevelResolver resolver(side.width, side.height, area, run.kernels, contacts);
  if (run.kernels.size() > 1) run.biases[index] = chooseKernels(run, side, contacts, area, resolver);
  const SideInput s{in, side, resolver, run.usual(), contacts, run.scales};
  const std::vector<Rgbd> photons = in.photons > 0 ? addSet(s, false, out, maps) : std::vector<Rgbd>(side.texelCount());
  std::vector<Rgbd> irradiance = photons;
  if (in.samples > 0) {
    const std::vector<Rgbd> direct = addSet(s, true, out, maps);
    for (std::size_t t = 0; t < irradiance.size(); ++t) irradiance[t] += direct[t];
  }
  for (std::size_t t = 0; t < irradiance.size(); ++t) maps.irradiance[out.firstTexel + t] = Rgb(irradiance[t]);
  if (maps.hasMeans()) resolveMeans(s, run.directions, out, maps);
  const auto statistics = statisticsOf(in.tallies, side);
  for (std::size_t t = 0; t < irradiance.size(); ++t)
    maps.photons[out.firstTexel + t] = static_cast<float>(statistics[kStatisticsChannels * t + kCount]);
  run.errors[index] = sideErrors(s, photons);
}

/// With the ratios of all sides known.
void fillErrors(const std::vector<SideErrors>& errors, LightMaps& maps) {
  ErrorRatios photons, direct;
  for (const SideErrors& e : errors) {
    photons += e.photons.ratios;
    direct += e.direct.ratios;
  }
  tbb::parallel_for(std::size_t{0}, errors.size(), [&](std::size_t s) {
    const SideMaps& side = maps.sides[s];
    if (!side.lit) return;
    const std::vector<float> deviations = errors[s].deviations(photons, direct);
    for (std::size_t t = 0; t < deviations.size(); ++t) {
      const std::size_t texel = side.firstTexel + t;
      const float e = luminance(maps.irradiance[texel]);
      maps.standardError[texel] = deviations[t];
      maps.relativeError[texel] = e > 0 ? deviations[t] / e : 0.f;
    }
  });
}

}  // namespace

LightMaps resolve(const ResolveInput& in, const KernelOptions& options, KernelBias* bias) {
  LightMaps maps;
  maps.directionCount = in.directionCount;
  maps.charts = describeCharts(in);
  planMaps(in, maps);
  ResolveRun run{in, kernelLevels(options), scalesOf(in), maps, std::vector<SideErrors>(maps.sides.size()),
                 std::vector<KernelBias>(maps.sides.size())};
  if (maps.hasMeans()) run.directions = spreadDirections(in.directionCount);
  tbb::parallel_for(std::size_t{0}, maps.sides.size(), [&](std::size_t s) { resolveSide(run, s); });
  fillErrors(run.errors, maps);
  for (const KernelBias& b : run.biases)
    if (bias != nullptr) *bias += b;
  return maps;
}

namespace {

/// Units of a set, all directions together.
std::vector<std::int64_t> sumOfMaps(const ResolveInput& in, const Tallies& set, const TallySide& side) {
  std::vector<std::int64_t> sum(kLightChannels * side.texelCount());
  for (std::uint64_t k = 0; k < in.tallyLayout.membersOf(side).mapCount(); ++k) {
    const auto units = mapUnits(set, side, k);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += units[i];
  }
  return sum;
}

/// What a side gives to the estimate: its flux, and its errors until the ratios of all sides are known.
struct SideEstimate {
  double flux = 0;
  SideErrors errors;
};

/// With the kernel of each texel chosen as resolveSide() does.
SideEstimate estimateSide(const ResolveRun& run, std::size_t index) {
  const ResolveInput& in = run.in;
  const TallySide& side = in.tallyLayout.sides[index];
  const std::span<const double> area = areaOf(in, side);
  const SideContacts none;
  const SideContacts& contacts = in.contacts.empty() ? none : in.contacts[index];
  LevelResolver resolver(side.width, side.height, area, run.kernels, contacts);
  if (run.kernels.size() > 1) chooseKernels(run, side, contacts, area, resolver);
  const SideInput s{in, side, resolver, run.usual(), contacts, run.scales};
  std::vector<Rgbd> photons(side.texelCount()), direct(side.texelCount());
  if (in.photons > 0) photons = resolver.filterRgb(sumOfMaps(in, in.tallies, side));
  if (in.samples > 0) direct = resolver.filterMeans(sumOfMaps(in, *in.tallies.direct(), side), area);
  SideEstimate estimate;
  for (std::size_t t = 0; t < photons.size(); ++t) {
    photons[t] = photons[t] * run.scales.photons;
    estimate.flux += area[t] * luminance(photons[t] + direct[t] * run.scales.direct);
  }
  estimate.errors = sideErrors(s, photons);
  return estimate;
}

}  // namespace

double estimateRelativeError(const ResolveInput& in, const KernelOptions& options) {
  LightMaps none;
  const ResolveRun run{in, kernelLevels(options), scalesOf(in), none, {}, {}};
  std::vector<SideEstimate> sides(in.tallyLayout.sides.size());
  const std::vector<const Tallies*> sets = setsOf(in);
  tbb::parallel_for(std::size_t{0}, sides.size(), [&](std::size_t s) {
    const bool lit = std::any_of(sets.begin(), sets.end(), [&](const Tallies* set) {
      return anyNonZero(statisticsOf(*set, in.tallyLayout.sides[s]));
    });
    if (lit) sides[s] = estimateSide(run, s);
  });
  ErrorRatios photons, direct;
  double error = 0, flux = 0;
  for (const SideEstimate& side : sides) {
    photons += side.errors.photons.ratios;
    direct += side.errors.direct.ratios;
    flux += side.flux;
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const std::span<const double> area = areaOf(in, in.tallyLayout.sides[s]);
    const std::vector<float> deviations = sides[s].errors.deviations(photons, direct);
    for (std::size_t t = 0; t < deviations.size(); ++t) error += area[t] * static_cast<double>(deviations[t]);
  }
  return flux > 0 ? error / flux : 0;
}

double estimatedRelativeError(const LightMaps& maps, const TexelLayout& layout) {
  double error = 0, flux = 0;
  for (const SideMaps& side : maps.sides) {
    if (!side.lit) continue;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
      const double area = layout.area[layout.charts[side.chart].firstTexel + t];
      flux += area * static_cast<double>(luminance(maps.irradiance[side.firstTexel + t]));
      error += area * static_cast<double>(maps.standardError[side.firstTexel + t]);
    }
  }
  return flux > 0 ? error / flux : 0;
}

}  // namespace lucarne
