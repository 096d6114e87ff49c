// Light maps of fewer directions, for GPUs with too little memory.
#pragma once

#include "dlm/light_maps.h"

namespace lucarne {

/// The light of each ψ goes to the nearest of `directionCount` (fewer than now): the sum over the directions of a side,
/// its irradiance, stays what it was, up to the rounding of floats. Mean directions are averaged by their light.
/// Everything else is kept.
LightMaps withFewerDirections(const LightMaps& maps, int directionCount);

}  // namespace lucarne
