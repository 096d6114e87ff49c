// Merging of charts: what growth left between its charts joins a neighbour where it can.
#pragma once

#include <vector>

#include "dlm/chart_faces.h"
#include "dlm/chart_overlap.h"

namespace lucarne {

/// First small neighbours join each other around their common mean normal, then charts take in small neighbours that
/// fit their plane as it is. The bounds of GrownChart hold for the result.
std::vector<GrownChart> mergeCharts(const ChartFaces& faces, std::vector<GrownChart> charts, double cosMaxAngle,
                                    PlaneTriangleSet& overlaps);

}  // namespace lucarne
