#include "tracer/scene/gltf_reader.h"

#include "tracer/scene/gltf_geometry.h"
#include "tracer/scene/gltf_left_out.h"
#include "tracer/scene/gltf_lights.h"
#include "tracer/scene/gltf_materials.h"
#include "tracer/scene/local_frame.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {

void placeInFrame(Scene& scene) {
  for (Light& light : scene.lights) light.position = scene.frame.toLocal(light.position);
  for (Camera& camera : scene.cameras) camera.position = scene.frame.toLocal(camera.position);
}

void dropUnusedDefault(Scene& scene) {
  const auto last = static_cast<std::uint32_t>(scene.materials.size() - 1);
  bool used = last == 0;
  for (const Triangle& t : scene.triangles) used |= t.material == last;
  if (!used) scene.materials.pop_back();
}

Scene readScene(std::shared_ptr<const GltfSource> source) {
  Scene scene;
  const std::vector<WorldNode> nodes = flattenNodes(source->json, source->place());
  const std::vector<PrimitiveUse> uses = trianglePrimitives(*source, nodes);
  if (uses.empty()) source->place().fail("has no triangles");
  scene.frame = localFrameOf(trianglesBox(*source, nodes, uses));
  GltfMaterials materials = readMaterials(*source, scene.leftOut);
  scene.images = readImages(*source, materials, scene.leftOut);  // may drop normal maps, and so tangents
  readGeometry(*source, nodes, uses, materials, scene);
  markSkipped(scene);
  scene.materials = std::move(materials.materials);
  scene.textures = std::move(materials.textures);
  dropUnusedDefault(scene);
  scene.lights = readLights(*source, nodes, scene.leftOut);
  scene.cameras = readCameras(*source, nodes, scene.leftOut);
  placeInFrame(scene);
  const std::vector<std::string> more = listLeftOut(*source, nodes, scene);
  scene.leftOut.insert(scene.leftOut.end(), more.begin(), more.end());
  scene.source = std::move(source);
  return scene;
}

/// Types are checked before they are used; should one have been forgotten, the file is still only a bad file.
template <class Load>
Scene guarded(const std::string& name, const Load& load) {
  try {
    return readScene(load());
  } catch (const Json::exception& e) {
    throw InputError(name + ": " + e.what());
  }
}

}  // namespace

Scene readGltf(const std::filesystem::path& path) {
  return guarded(path.string(), [&] { return loadGltfSource(path); });
}

Scene readGlb(std::span<const std::uint8_t> bytes, const std::string& name) {
  return guarded(name, [&] { return loadGltfSource(bytes, name); });
}

}  // namespace lucarne
