// The scene that a part carries.
#pragma once

#include "distributed/part_file.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// Reads the part whole; PartError where it is damaged or what it carries is no scene.
Scene sceneOfPart(const PartReader& part);

}  // namespace lucarne
