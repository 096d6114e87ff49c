// The surfaces section of a check: which meshes close, and which are seen from behind.
#pragma once

#include "app/check_input.h"

namespace lucarne {

/// Of every mesh that a node places: meshes, closed (every edge has two triangles), open, one_sided_open (open, of a
/// material that is black from behind), crowded_edges (with more than two triangles), and `list`: the open ones of
/// most edges [{name, open_edges, triangles, one_sided, material}], at most 20. Corners in one place count as joined.
nlohmann::json checkSurfaces(const Scene& scene);

}  // namespace lucarne
