#include "tracer/scene/gltf_references.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lucarne {
namespace {

constexpr std::array<std::string_view, 6> kWithoutReferences = {
    "KHR_lights_punctual",     "KHR_materials_variants", "KHR_xmp_json_ld",
    "KHR_animation_pointer",   "KHR_node_visibility",
    "EXT_mesh_gpu_instancing",  // has references; markInstancing follows them
};

bool isHarmless(const std::string& name) {
  return std::find(kWithoutReferences.begin(), kWithoutReferences.end(), name) != kWithoutReferences.end() ||
         name.find("_materials_") != std::string::npos || name.find("_lights_") != std::string::npos;
}

bool hasUnknownExtension(const Json& object) {
  const Json* extensions = findMember(object, "extensions");
  if (extensions == nullptr || !extensions->is_object()) return false;
  for (const auto& [name, value] : extensions->items()) {
    if (!isHarmless(name)) return true;
  }
  return false;
}

bool mayReferUnseen(const Json& json) {
  if (hasUnknownExtension(json)) return true;
  for (const char* key : {"nodes", "meshes", "accessors", "bufferViews", "skins", "animations"}) {
    const Json* list = findMember(json, key);
    if (list != nullptr && std::any_of(list->begin(), list->end(), hasUnknownExtension)) return true;
  }
  const Json* meshes = findMember(json, "meshes");
  return meshes != nullptr && std::any_of(meshes->begin(), meshes->end(), [](const Json& mesh) {
           const Json* primitives = findMember(mesh, "primitives");
           return primitives != nullptr && std::any_of(primitives->begin(), primitives->end(), hasUnknownExtension);
         });
}

void mark(std::vector<std::uint8_t>& used, const Json& value) {
  if (!value.is_number()) return;
  const auto index = value.get<std::uint64_t>();
  if (index < used.size()) used[index] = 1;
}

void markMember(std::vector<std::uint8_t>& used, const Json& object, const char* key) {
  const Json* member = findMember(object, key);
  if (member != nullptr) mark(used, *member);
}

void markAll(std::vector<std::uint8_t>& used, const Json& attributes) {
  for (const Json& value : attributes) mark(used, value);
}

template <class Visit>
void forEachOf(const Json& object, const char* key, const Visit& visit) {
  const Json* list = findMember(object, key);
  if (list == nullptr) return;
  for (const Json& element : *list) visit(element);
}

void markPrimitive(std::vector<std::uint8_t>& used, const Json& primitive) {
  const Json* attributes = findMember(primitive, "attributes");
  if (attributes != nullptr) markAll(used, *attributes);
  markMember(used, primitive, "indices");
  forEachOf(primitive, "targets", [&](const Json& target) { markAll(used, target); });
}

void markInstancing(std::vector<std::uint8_t>& used, const Json& node) {
  const Json* extensions = findMember(node, "extensions");
  const Json* instancing = extensions == nullptr ? nullptr : findMember(*extensions, "EXT_mesh_gpu_instancing");
  const Json* attributes = instancing == nullptr ? nullptr : findMember(*instancing, "attributes");
  if (attributes != nullptr) markAll(used, *attributes);
}

void markAccessors(std::vector<std::uint8_t>& used, const Json& json) {
  forEachOf(json, "meshes", [&](const Json& mesh) {
    forEachOf(mesh, "primitives", [&](const Json& primitive) { markPrimitive(used, primitive); });
  });
  forEachOf(json, "skins", [&](const Json& skin) { markMember(used, skin, "inverseBindMatrices"); });
  forEachOf(json, "animations", [&](const Json& animation) {
    forEachOf(animation, "samplers", [&](const Json& sampler) {
      markMember(used, sampler, "input");
      markMember(used, sampler, "output");
    });
  });
  forEachOf(json, "nodes", [&](const Json& node) { markInstancing(used, node); });
}

void markViews(UsedReferences& used, const Json& json) {
  std::size_t i = 0;
  forEachOf(json, "accessors", [&](const Json& accessor) {
    if (used.accessors[i++] == 0) return;
    markMember(used.views, accessor, "bufferView");
    const Json* sparse = findMember(accessor, "sparse");
    if (sparse == nullptr) return;
    markMember(used.views, (*sparse)["indices"], "bufferView");
    markMember(used.views, (*sparse)["values"], "bufferView");
  });
  forEachOf(json, "images", [&](const Json& image) { markMember(used.views, image, "bufferView"); });
}

}  // namespace

UsedReferences usedReferences(const Json& json) {
  const std::uint8_t all = mayReferUnseen(json) ? 1 : 0;
  UsedReferences used{std::vector<std::uint8_t>(sizeOf(json, "accessors"), all),
                      std::vector<std::uint8_t>(sizeOf(json, "bufferViews"), all)};
  markAccessors(used.accessors, json);
  markViews(used, json);
  return used;
}

}  // namespace lucarne
