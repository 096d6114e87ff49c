// Meshes of two versions of a scene, compared.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// The name of a mesh as the file has it, else that of the node that places it, else "mesh 3".
std::string meshName(const Scene& scene, const PrimitiveInstance& instance);

/// Adds lines like "mesh 'floor': vertices moved".
void addMeshDifferences(const Scene& before, const Scene& after, std::vector<std::string>& list);

}  // namespace lucarne
