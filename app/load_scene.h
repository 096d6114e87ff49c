// The scene that options name.
#pragma once

#include "app/bake_options.h"
#include "tracer/scene/gltf_packer.h"

namespace lucarne {

/// The file of the options, or the built-in room. InputError as in readGltf().
PackedScene loadScene(const BakeOptions& options);

}  // namespace lucarne
