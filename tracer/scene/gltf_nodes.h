// The node hierarchy: checked to be a forest, and flattened to world transforms in double precision.
#pragma once

#include <vector>

#include "base/vec.h"
#include "tracer/scene/gltf_json.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Every child exists, has one parent, and no node is its own ancestor; scenes list roots, each once. Checks the
/// transforms too.
void validateNodeGraph(const Json& json, const Place& file);

struct WorldNode {
  std::uint32_t node = 0;
  Affine world;
  Affine rotation;       // the same without any scale: what is left of the orientation where a scale is zero
  bool mirrors = false;  // negative determinant: the winding of triangles turns round
  double texelsPerMetre = 0;  // extras "lucarne.texels_per_metre" of the node or the nearest ancestor that has it; 0: none
};

/// The nodes of the default scene (else scene 0, else all roots) in depth-first order, parents first.
std::vector<WorldNode> flattenNodes(const Json& json, const Place& file);

/// The linear part scaled by a power of two so that its largest entry lies in [1, 2): determinants and cofactors of it
/// neither overflow nor vanish. All zeros stay.
Affine balanced(const Affine& a);

}  // namespace lucarne
