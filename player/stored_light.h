// What the directional maps hold at a point, read back from the GPU.
#pragma once

#include <vector>

#include "player/map_upload.h"

namespace lucarne {

/// Of the stored maps of a side, in their order: lx, bilinear at texel coordinates `st` of its rectangle, clamped to it. `side` is
/// one of the light maps that were uploaded. Needs a current context.
std::vector<Rgbd> storedLight(const GpuMaps& gpu, const LightMaps& maps, std::uint32_t side, Vec2d st);

}  // namespace lucarne
