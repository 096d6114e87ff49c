// The structure of a glTF document: types of the members that we use, every reference between its objects, bounds of
// buffer views and accessors, required extensions, and a node graph that is a forest. Nothing reads the document before
// this has passed.
#pragma once

#include "tracer/scene/gltf_json.h"

namespace lucarne {

/// Throws an InputError that names the first wrong place.
void validateGltf(const Json& json, const Place& file);

}  // namespace lucarne
