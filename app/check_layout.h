// Sections of a check that tell what the light maps will be and what they take: layout, resources.
#pragma once

#include "app/check_input.h"

namespace lucarne {

/// charts, chart_sides, sides_with_directions, directions, texels (of all chart sides), covered_texels (with surface in
/// them), texels_per_metre asked for and _used, thinned (the budget lowered it), mean_texel_mm,
/// texels_per_metre_min, _median (by surface) and _max of charts at least two texels wide and high (0: there are none),
/// largest_chart {width, height, material}, tiny_charts (with less surface than a tenth of a texel) and tiny_charts_area_share (of all).
nlohmann::json checkLayout(const CheckInput& input, CheckWarnings& warnings);

/// Bytes: tally_bytes; expected_peak_memory_bytes as bake_needs.h predicts it; free_memory_bytes; at most map_bytes in memory
/// and dlm_bytes on disk before compression; checkpoint_bytes (two states and one being written); free_disk_bytes of
/// the folder it is run in.
/// Failures: more memory than is free, for which a bake would not start.
nlohmann::json checkResources(const CheckInput& input, CheckWarnings& warnings, CheckWarnings& failures);

}  // namespace lucarne
