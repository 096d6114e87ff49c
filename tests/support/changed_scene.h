// A scene that ships, with a change in its document.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/files.h"
#include "tracer/scene/gltf_packer.h"
#include "tracer/scene/gltf_source.h"

namespace lucarne::test {

/// Bytes of the Cornell box (meshes floor, ceiling, light, …; materials white, light, green, red) after `change`.
inline std::vector<std::uint8_t> changedCornellBox(const std::function<void(Json&)>& change) {
  GltfSource source = *loadGltfSource(std::filesystem::path(LUCARNE_SOURCE_DIR "/scenes/cornell_box.glb"));
  change(source.json);
  return packGltf(source);
}

inline void writeChangedCornellBox(const std::filesystem::path& path, const std::function<void(Json&)>& change) {
  writeFileAtomically(path, changedCornellBox(change));
}

/// Moves the camera, adds one of the name given, renames a mesh and a material, adds extras: nothing that light
/// touches.
inline void changeWhatLightDoesNotTouch(Json& json, const std::string& cameraName = "new view") {
  json["nodes"][8]["translation"][2] = -0.7;
  json["cameras"].push_back({{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}});
  json["nodes"].insert(json["nodes"].begin(), json["nodes"][8]);
  json["nodes"][0]["camera"] = 1;
  json["nodes"][0]["name"] = cameraName;
  for (Json& node : json["scenes"][0]["nodes"]) node = node.get<int>() + 1;
  json["scenes"][0]["nodes"].push_back(0);
  json["meshes"][0]["name"] = "ground";
  json["materials"][0]["name"] = "chalk";
  json["extras"] = {{"author", "somebody else"}};
}

}  // namespace lucarne::test
