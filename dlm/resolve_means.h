// Moments become mean directions.
#pragma once

#include "dlm/side_input.h"

namespace lucarne {

/// Fills the mean directions of a side whose light is there; `directions`: Ω. Where a stored map is dark they are those of the lit
/// neighbours, else ψ: light that is interpolated from dark to lit comes from where the lit texel has it from.
void resolveMeans(const SideInput& input, std::span<const Vec3d> directions, const SideMaps& side, LightMaps& maps);

}  // namespace lucarne
