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

BakePlan makePlan(const Scene& scene, const BakeOptions& options);

}  // namespace lucarne
