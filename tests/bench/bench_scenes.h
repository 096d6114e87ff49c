// The scenes of bench_rays, made in memory, always the same triangle by triangle. Closed, diffuse (albedo 0.5 to 0.7),
// lit by one rectangle in the ceiling. Curved surfaces share their vertices and have vertex normals; whether shading
// interpolates them is the caller's choice.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne::bench {

struct SceneRecipe {
  std::string name;
  Scene (*make)(bool smooth);  // smooth: shading interpolates the vertex normals of curved surfaces
};

/// "room": walls in strips and 12 boxes, 192 triangles. "room_250k": the same with 8 spheres and 6 tori, 258,240
/// triangles. "hall_1m": a hall of two storeys, with fluted columns, arches and drapes, about 1.3 million triangles.
const std::vector<SceneRecipe>& sceneRecipes();

}  // namespace lucarne::bench
