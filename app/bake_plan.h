// All that is fixed before the first photon: charts, texels, directions, tallies.
#pragma once

#include "app/bake_options.h"
#include "dlm/charts.h"
#include "dlm/direction_set.h"
#include "dlm/tally.h"
#include "dlm/texel_layout.h"

namespace lucarne {

struct BakePlan {
  ChartSet charts;
  TexelLayout layout;
  DirectionSet directions;
  TallyLayout tallies;
};

/// What making and writing light maps takes beside the tallies: 0.87 times their size was measured (docs/scaling.md).
constexpr std::uint64_t memoryOfMaps(std::uint64_t tallyBytes) { return tallyBytes; }

/// Of all sets together.
inline std::uint64_t tallyBytes(const BakePlan& plan, const BakeOptions& options) {
  return plan.tallies.bytes() * (gathersDirect(options) ? 2 : 1);
}

/// Error(outOfResource) when the layout has more than `texelLimit` texels, before memory is taken for them.
BakePlan makePlan(const Scene& scene, const BakeOptions& options, std::uint64_t texelLimit = ~std::uint64_t{0});

}  // namespace lucarne
