// Light maps that fit into the memory there is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "dlm/light_maps.h"
#include "player/layered_pack.h"
#include "player/render_options.h"

namespace lucarne {

struct MapFit {
  LightMapFormat format = LightMapFormat::half;
  std::optional<LightMaps> fewer;  // instead of the light maps as they are
  std::string note;                // one line: what was made smaller, and why; empty where nothing was
};

/// A smaller format first, then half the directions, again and again, until the textures of the light maps take no more
/// than `memory` bytes (0: nothing is known, nothing is changed). Error(outOfResource) where even one direction is too
/// much.
MapFit fitMaps(const LightMaps& maps, LightMapFormat wanted, std::uint64_t memory, const TextureLimits& limits);

/// Bytes that the current context's driver says are free; 0 where it does not say.
std::uint64_t freeGpuMemory();

}  // namespace lucarne
