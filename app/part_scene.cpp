#include "app/part_scene.h"

#include "tracer/scene/gltf_reader.h"

namespace lucarne {

Scene sceneOfPart(const PartReader& part) {
  std::vector<std::uint8_t> glb;
  part.stream(
      {.scene = [&glb](std::span<const std::uint8_t> bytes) { glb.insert(glb.end(), bytes.begin(), bytes.end()); },
       .tallies = {}});
  try {
    return readGlb(glb, part.path().string() + ": scene");
  } catch (const InputError& error) {
    throw PartError(error.what());
  }
}

}  // namespace lucarne
