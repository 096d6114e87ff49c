// How a bake stands to a scene file as it is now.
#include "app/bake_identity.h"
#include "app/info.h"
#include "app/part_scene.h"
#include "app/scene_difference.h"
#include "base/error.h"
#include "dlm/dlm_reader.h"
#include "dlm/dlm_writer.h"
#include "tracer/scene/gltf_packer.h"
#include "tracer/scene/light_hash.h"

namespace lucarne {
namespace {

struct Now {
  Scene scene;
  Hash128 light, file;
};

Now sceneNow(const std::filesystem::path& path) {
  PackedScene packed = readPacked(path);
  const Hash128 light = lightHash(packed.scene), file = hashBytes(packed.glb);
  return {std::move(packed.scene), light, file};
}

nlohmann::json answer(bool matches, bool sameFile, std::vector<std::string> differences) {
  if (matches && !sameFile) differences.emplace_back("only what light does not touch (cameras, names, extras)");
  return {{"matches", matches}, {"same_file", sameFile}, {"differences", differences}};
}

nlohmann::json comparePart(const PartReader& part, const Now& now) {
  const PartHeader& h = part.header();
  const bool matches = h.identity.scene == now.light;
  return answer(matches, h.sceneFile == now.file,
                matches ? std::vector<std::string>() : sceneDifferences(sceneOfPart(part), now.scene));
}

std::string textAt(const nlohmann::json& manifest, const char* key) {
  const auto at = manifest.find(key);
  return at != manifest.end() && at->is_string() ? at->get<std::string>() : std::string();
}

/// Light maps keep their scene cut up along the charts, so that only its hash can be compared.
nlohmann::json compareDlm(const std::filesystem::path& path, const Now& now) {
  const nlohmann::json manifest = readManifest(path);
  const bool matches = textAt(manifest, "scene_hash") == now.light.hex();
  std::vector<std::string> differences;
  if (!matches)
    differences.emplace_back("the scene is not the one that was baked; a part (--keep-part) could say in what");
  return answer(matches, textAt(manifest, "scene_file_hash") == now.file.hex(), differences);
}

}  // namespace

nlohmann::json compareWithScene(const std::filesystem::path& path, const std::filesystem::path& scene) {
  const bool maps = holdsLightMaps(path);
  if (!maps && !isPart(path)) throw InputError(path.string() + ": --scene compares a .part or a .dlm with a scene");
  const Now now = sceneNow(scene);
  nlohmann::json result = maps ? compareDlm(path, now) : comparePart(PartReader(path), now);
  result["scene"] = scene.string();
  return result;
}

}  // namespace lucarne
