// Charts from the scene's own unwrapping, TEXCOORD_1, where it can hold light maps.
#pragma once

#include <string>
#include <vector>

#include "dlm/charts.h"
#include "dlm/half_edge_mesh.h"

namespace lucarne {

struct Uv1Islands {
  std::vector<std::vector<std::uint32_t>> islands;  // triangles of each, ascending
  std::vector<std::string> refused;                 // for each mesh with a TEXCOORD_1 that cannot be used: why
};

/// Takes the unwrapping of each instance of a mesh whole or not at all. It is refused where it leaves 0..1, where two of
/// its triangles overlap, and where a triangle with surface has none there. An island is what hangs together in space
/// and in the unwrapping, within one material and without a crease: light does not bleed across one. `mesh`: with its
/// creases cut.
Uv1Islands findUv1Islands(const Scene& scene, const HalfEdgeMesh& mesh);

/// Lays an island out as the file has it, turned over where it is mirrored, scaled so that its area there is that of
/// its surface: triangles keep the shares of texels that the unwrapping gives them. Fills in set.cornerUv.
Chart uv1Chart(const Scene& scene, const std::vector<std::uint32_t>& island, double minSize, ChartSet& set);

}  // namespace lucarne
