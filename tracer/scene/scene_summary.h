// A scene in numbers, for people and programs that ask what a file holds.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tracer/scene/scene.h"

namespace lucarne {

/// Keys: triangles, degenerate_triangles (no area), duplicate_triangles, smooth_triangles, double_sided_triangles,
/// emissive_triangles, vertices, primitives, materials, double_sided_materials, emissive_materials [{name,
/// emissive_cd_per_m2}], textures, images, lights [{name, kind, intensity, unit}], cameras [{name, position_m, yfov}],
/// bounds_m {min, max, size}, charts (of a scene placed in an atlas, else 0), left_out.
nlohmann::json summarize(const Scene& scene);

}  // namespace lucarne
