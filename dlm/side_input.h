// One chart side, and what its maps are made with.
#pragma once

#include <span>

#include "dlm/resolve.h"
#include "dlm/kernel_levels.h"
#include "tracer/transport/ledger.h"

namespace lucarne {

/// What turns units into lx: those of photons over local area, those of gathered samples by themselves.
struct Scales {
  double photons = 0, direct = 0;
};

struct SideInput {
  const ResolveInput& in;
  const TallySide& side;
  const LevelResolver& resolver;
  const Kernel& kernel;  // that at most texels, for what need not be exact
  const SideContacts& contacts;
  Scales scales;
  std::span<const double> area() const {
    return {in.layout.area.data() + in.layout.charts[side.chart].firstTexel, side.texelCount()};
  }
  /// What of it light reaches.
  std::vector<double> openArea() const {
    std::vector<double> open(area().begin(), area().end());
    for (std::size_t t = 0; t < open.size(); ++t) open[t] *= contacts.share(t);
    return open;
  }
};

/// [texel][r, g, b] of map `rank` of the side.
inline std::span<const std::int64_t> mapUnits(const Tallies& set, const TallySide& side, std::uint64_t rank) {
  return set.light().subspan((side.firstLight + rank * side.texelCount()) * kLightChannels,
                             side.texelCount() * kLightChannels);
}

/// [texel][x, y, z] of the moments of map `rank`.
inline std::span<const std::int64_t> momentUnits(const Tallies& set, const TallySide& side, std::uint64_t rank) {
  return set.moments().subspan((side.firstMoment + rank * side.texelCount()) * kMomentChannels,
                               side.texelCount() * kMomentChannels);
}

/// [texel][count, m2, odd].
inline std::span<const std::int64_t> statisticsOf(const Tallies& set, const TallySide& side) {
  return set.statistics().subspan(side.firstTexel * kStatisticsChannels, side.texelCount() * kStatisticsChannels);
}

}  // namespace lucarne
