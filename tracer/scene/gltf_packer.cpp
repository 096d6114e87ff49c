#include "tracer/scene/gltf_packer.h"

#include "tracer/scene/gltf_document.h"
#include "tracer/scene/gltf_embed.h"
#include "tracer/scene/gltf_reader.h"

namespace lucarne {

std::vector<std::uint8_t> packGltf(const GltfSource& source) {
  UsedReferences all;
  all.accessors.assign(source.list("accessors").size(), 1);
  all.views.assign(source.list("bufferViews").size(), 1);
  GltfDocument document(source.json, source, all);
  embedImages(source, document);
  return document.finish();
}

PackedScene readPacked(const std::filesystem::path& path) {
  std::vector<std::uint8_t> glb;
  try {
    glb = packGltf(*loadGltfSource(path));
  } catch (const Json::exception& e) {  // a type that was not checked: still only a bad file
    throw InputError(path.string() + ": " + e.what());
  }
  Scene scene = readGlb(glb, path.string());
  return {std::move(glb), std::move(scene)};
}

}  // namespace lucarne
