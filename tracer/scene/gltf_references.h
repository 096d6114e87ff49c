// What of a glTF document refers to accessors and buffer views.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/scene/gltf_json.h"

namespace lucarne {

struct UsedReferences {
  std::vector<std::uint8_t> accessors, views;  // 1 where something refers to it
};

/// References of primitives, skins, animations, instancing and images. Everything counts as used when an extension that
/// we do not know stands where it could refer to geometry.
UsedReferences usedReferences(const Json& json);

}  // namespace lucarne
