#include "tracer/scene/gltf_validate.h"

#include <array>

#include "tracer/scene/gltf_accessor.h"
#include "tracer/scene/gltf_extensions.h"
#include "tracer/scene/gltf_nodes.h"
#include "tracer/scene/gltf_validate_mesh.h"

namespace lucarne {
namespace {

constexpr std::array kTopLevelArrays = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                        "images",    "materials",  "meshes",  "nodes",       "samplers",
                                        "scenes",    "skins",      "textures"};

template <class Check>
void forEach(const Json& json, const char* key, const Place& place, const Check& check) {
  const Json& list = objectArray(json, key, place);
  for (std::size_t i = 0; i < list.size(); ++i) check(list[i], place.in(key, i));
}

void validateAsset(const Json& json, const Place& file) {
  const Json* asset = findObject(json, "asset", file);
  if (asset == nullptr) file.fail("has no asset; it is not glTF 2.0");
  const std::string version = textOf(*asset, "version", "", file.in("asset"));
  const std::string least = textOf(*asset, "minVersion", "2.0", file.in("asset"));
  if (version.substr(0, 2) != "2." || least != "2.0")
    file.fail("is not glTF 2.0 (version \"" + version + "\"); export it as 2.0");
}

void validateRequiredExtensions(const Json& json, const Place& file) {
  for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
    const Json* names = findArray(json, key, file);
    if (names == nullptr) continue;
    for (const Json& name : *names) {
      if (!name.is_string()) file.in(key).fail("holds something that is not a string");
      if (std::string_view(key) == "extensionsRequired")
        requireKnownExtension(name.get_ref<const std::string&>(), file);
    }
  }
}

void validateBufferViews(const Json& json, const Place& file) {
  forEach(json, "buffers", file, [](const Json& buffer, const Place& place) {
    if (requiredCount(buffer, "byteLength", place) < 1) place.fail("has the byteLength 0");
    textOf(buffer, "uri", "", place);
  });
  forEach(json, "bufferViews", file, [&](const Json& view, const Place& place) {
    const std::uint32_t buffer = requiredIndex(view, "buffer", sizeOf(json, "buffers"), place);
    const std::uint64_t available = requiredCount(json["buffers"][buffer], "byteLength", place);
    const std::uint64_t offset = countOf(view, "byteOffset", 0, place),
                        length = requiredCount(view, "byteLength", place);
    if (length < 1 || offset > available || length > available - offset)
      place.fail("reaches past the end of its buffer");
    const std::uint64_t stride = countOf(view, "byteStride", 4, place);
    if (stride < 4 || stride > 252 || stride % 4 != 0) place.fail("has a byteStride that is not 4, 8 … 252");
    if (findMember(view, "byteStride") != nullptr && stride > length) place.fail("has a byteStride longer than itself");
  });
}

void validateImages(const Json& json, const Place& file) {
  forEach(json, "images", file, [&](const Json& image, const Place& place) {
    textOf(image, "uri", "", place);
    textOf(image, "mimeType", "", place);
    textOf(image, "name", "", place);
    const bool inView = indexOf(image, "bufferView", sizeOf(json, "bufferViews"), place) != kNone;
    if (inView == (findMember(image, "uri") != nullptr)) place.fail("has not exactly one of uri and bufferView");
  });
  // A texture may name an image that is not there: exporters do, and white stands in for it.
  forEach(json, "textures", file, [&](const Json& texture, const Place& place) {
    indexOf(texture, "source", kNone, place);
    indexOf(texture, "sampler", sizeOf(json, "samplers"), place);
  });
}

/// All texture infos of a material, those of extensions too: objects in members named …Texture.
void validateTextureInfos(const Json& object, std::size_t textures, const Place& place) {
  for (const auto& [key, value] : object.items()) {
    if (!value.is_object() || key == "extras") continue;
    if (key.ends_with("Texture") && value.contains("index")) {
      requiredIndex(value, "index", textures, place.in(key));
      countOf(value, "texCoord", 0, place.in(key));
    }
    validateTextureInfos(value, textures, place.in(key));
  }
}

void validateAnimations(const Json& json, const Place& file) {
  forEach(json, "animations", file, [&](const Json& animation, const Place& place) {
    const Json& samplers = objectArray(animation, "samplers", place);
    forEach(animation, "samplers", place, [&](const Json& sampler, const Place& at) {
      requiredIndex(sampler, "input", sizeOf(json, "accessors"), at);
      requiredIndex(sampler, "output", sizeOf(json, "accessors"), at);
    });
    forEach(animation, "channels", place, [&](const Json& channel, const Place& at) {
      requiredIndex(channel, "sampler", samplers.size(), at);
      const Json* target = findObject(channel, "target", at);
      if (target == nullptr) at.fail("has no target");
      indexOf(*target, "node", sizeOf(json, "nodes"), at.in("target"));
    });
  });
}

void validateSkins(const Json& json, const Place& file) {
  forEach(json, "skins", file, [&](const Json& skin, const Place& place) {
    const Json* joints = findArray(skin, "joints", place);
    if (joints == nullptr) place.fail("has no joints");
    for (const Json& joint : *joints) asIndex(joint, sizeOf(json, "nodes"), place.in("joints"));
    indexOf(skin, "skeleton", sizeOf(json, "nodes"), place);
    indexOf(skin, "inverseBindMatrices", sizeOf(json, "accessors"), place);
  });
}

void validateNodes(const Json& json, const Place& file) {
  static const Json none = Json::object();
  const Json* root = findExtension(json, "KHR_lights_punctual", file);
  const Json& lights = root == nullptr ? none : *root;
  forEach(lights, "lights", file.in("extensions.KHR_lights_punctual"), [](const Json&, const Place&) {});
  forEach(json, "nodes", file, [&](const Json& node, const Place& place) {
    indexOf(node, "mesh", sizeOf(json, "meshes"), place);
    indexOf(node, "camera", sizeOf(json, "cameras"), place);
    indexOf(node, "skin", sizeOf(json, "skins"), place);
    textOf(node, "name", "", place);
    const Json* light = findExtension(node, "KHR_lights_punctual", place);
    if (light != nullptr)
      requiredIndex(*light, "light", sizeOf(lights, "lights"), place.in("extensions.KHR_lights_punctual"));
  });
  validateNodeGraph(json, file);
}

}  // namespace

void validateGltf(const Json& json, const Place& file) {
  validateAsset(json, file);
  validateRequiredExtensions(json, file);
  for (const char* key : kTopLevelArrays) objectArray(json, key, file);
  validateBufferViews(json, file);
  forEach(json, "accessors", file, [&](const Json& accessor, const Place& place) {
    static const Json none = Json::array();
    const Json* views = findMember(json, "bufferViews");
    validateAccessor(accessor, views == nullptr ? none : *views, place);
  });
  validateImages(json, file);
  forEach(json, "materials", file, [&](const Json& material, const Place& place) {
    validateTextureInfos(material, sizeOf(json, "textures"), place);
  });
  validateMeshes(json, file);
  validateAnimations(json, file);
  validateSkins(json, file);
  validateNodes(json, file);
}

}  // namespace lucarne
