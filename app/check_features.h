// Sections of a check that tell what is in the file: scene, modelled, uv.
#pragma once

#include "app/check_input.h"

namespace lucarne {

/// name, triangles, degenerate_triangles, materials (that triangles use), cameras, extent_m.
nlohmann::json checkSize(const CheckInput& input, CheckWarnings& warnings);

/// [{feature, of, count}]: what the scene has and the bake models; `of` is triangles, lights or materials. Only what is
/// there; materials without triangles do not count.
nlohmann::json listModelled(const Scene& scene);

/// The file's own unwrapping (TEXCOORD_1): present, and if so inside_unit_square, area (of all triangles in texture
/// space; above 1 some must overlap), triangles_without_area. Which meshes' unwrapping can be used is told by the
/// layout (uv1_charts) and by warnings.
nlohmann::json checkUv(const Scene& scene);

}  // namespace lucarne
