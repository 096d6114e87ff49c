// What differs between two versions of a scene, as far as light notices.
#pragma once

#include <string>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// In words: "light 'sun': intensity 3 → 4 lx", "mesh 'floor': vertices moved", "material 'wood': roughness 0.5 → 0.4".
/// Things are told apart by name, of equal names by their order. Empty only where lightHash() agrees. Cameras and names
/// do not count.
std::vector<std::string> sceneDifferences(const Scene& before, const Scene& after);

/// The first few, and how many more there are; one line.
std::string someOf(const std::vector<std::string>& differences);

}  // namespace lucarne
