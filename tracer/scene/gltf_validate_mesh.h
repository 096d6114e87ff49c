// The part of validation that is about meshes.
#pragma once

#include "tracer/scene/gltf_json.h"

namespace lucarne {

/// References of every primitive, formats of the attributes that we read, and one count for all attributes of a
/// primitive (indices are compared with it when they are read).
void validateMeshes(const Json& json, const Place& file);

}  // namespace lucarne
