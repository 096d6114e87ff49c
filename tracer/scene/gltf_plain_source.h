// A glTF document for a scene that was made in memory.
#pragma once

#include <memory>
#include <vector>

#include "tracer/scene/gltf_source.h"
#include "tracer/scene/scene.h"

namespace lucarne {

struct PlainSource {
  std::shared_ptr<const GltfSource> source;
  std::vector<PrimitiveInstance> instances;  // triangles of the scene, in its order
};

/// One mesh with a primitive for every run of triangles of one material, in the local frame under a node that brings it
/// to metres; lights, cameras, materials and textures as they are in the scene.
PlainSource plainSource(const Scene& scene);

}  // namespace lucarne
