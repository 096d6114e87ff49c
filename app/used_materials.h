// The materials that some triangle has.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// In the order of the scene; they are the scene's.
inline std::vector<const Material*> usedMaterials(const Scene& scene) {
  std::vector<std::uint8_t> used(scene.materials.size(), 0);
  for (const Triangle& t : scene.triangles) used[t.material] = 1;
  std::vector<const Material*> list;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] != 0) list.push_back(&scene.materials[i]);
  return list;
}

}  // namespace lucarne
