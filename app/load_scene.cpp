#include "app/load_scene.h"

#include "app/builtin_scene.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {

PackedScene loadScene(const BakeOptions& options) {
  if (options.scene) return readPacked(*options.scene);
  std::vector<std::uint8_t> glb = packGltf(*loadGltfSource(builtinScene(), "the built-in scene"));
  Scene scene = readGlb(glb, "the built-in scene");
  return {std::move(glb), std::move(scene)};
}

}  // namespace lucarne
