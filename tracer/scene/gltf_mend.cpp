#include "tracer/scene/gltf_mend.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace lucarne {
namespace {

/// Calls `visit` with every member "texCoord" of a material, those of extensions too.
template <class Visit>
void forEachTexcoord(Json& object, const Visit& visit) {
  for (auto it = object.begin(); it != object.end(); ++it) {
    if (it.key() == "extras") continue;
    if (it.key() == "texCoord" && it->is_number()) visit(*it);
    if (it->is_object()) forEachTexcoord(*it, visit);
  }
}

template <class Visit>
void forEachPrimitive(Json& json, const Visit& visit) {
  if (!json.contains("meshes")) return;
  for (Json& mesh : json["meshes"]) {
    if (!mesh.contains("primitives")) continue;
    for (Json& primitive : mesh["primitives"]) visit(primitive);
  }
}

void removeName(Json& json, const char* listKey, const std::string& name) {
  if (!json.contains(listKey)) return;
  Json& list = json[listKey];
  list.erase(std::remove(list.begin(), list.end(), Json(name)), list.end());
  if (list.empty()) json.erase(listKey);
}

void removeExtension(Json& object, const char* name) {
  if (!object.contains("extensions")) return;
  object["extensions"].erase(name);
  if (object["extensions"].empty()) object.erase("extensions");
}

void mendTextures(Json& json) {
  const std::size_t images = json.contains("images") ? json["images"].size() : 0;
  if (!json.contains("textures")) return;
  for (Json& texture : json["textures"]) {
    if (texture.contains("source") && texture["source"].get<std::uint64_t>() >= images) texture.erase("source");
  }
}

/// The strength takes a power of two, so that neither division nor product rounds.
bool mendEmission(Json& material) {
  if (!material.contains("emissiveFactor")) return false;
  double largest = 0;
  for (const Json& f : material["emissiveFactor"]) largest = std::max(largest, f.get<double>());
  if (largest <= 1) return false;
  const double power = std::ldexp(1.0, std::ilogb(largest) + 1);
  for (Json& f : material["emissiveFactor"]) f = f.get<double>() / power;
  Json& extension = material["extensions"]["KHR_materials_emissive_strength"];
  const double strength = extension.contains("emissiveStrength") ? extension["emissiveStrength"].get<double>() : 1.0;
  extension["emissiveStrength"] = strength * power;
  return true;
}

void mendMaterials(Json& json) {
  if (!json.contains("materials")) return;
  bool any = false;
  for (Json& material : json["materials"]) any |= mendEmission(material);
  if (!any) return;
  Json& used = json["extensionsUsed"];
  const Json name = "KHR_materials_emissive_strength";
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

}  // namespace

void freeTexcoord1(Json& json) {
  std::set<std::uint64_t> sets;
  if (json.contains("materials")) {
    for (Json& m : json["materials"]) forEachTexcoord(m, [&](Json& set) { sets.insert(set.get<std::uint64_t>()); });
  }
  if (!sets.contains(1)) return;
  const auto inPrimitives = [&](const std::string& name) {
    bool found = false;
    forEachPrimitive(json, [&](Json& primitive) { found |= primitive["attributes"].contains(name); });
    return found;
  };
  std::uint64_t target = 2;
  while (sets.contains(target) || inPrimitives("TEXCOORD_" + std::to_string(target))) ++target;
  for (Json& m : json["materials"]) {
    forEachTexcoord(m, [&](Json& set) {
      if (set == 1) set = target;
    });
  }
  forEachPrimitive(json, [&](Json& primitive) {
    Json& attributes = primitive["attributes"];
    if (!attributes.contains("TEXCOORD_1")) return;
    attributes["TEXCOORD_" + std::to_string(target)] = attributes["TEXCOORD_1"];
    attributes.erase("TEXCOORD_1");
  });
}

void mendDocument(Json& json) {
  mendTextures(json);
  mendMaterials(json);
  for (const char* key : {"buffers", "bufferViews"}) {
    if (!json.contains(key)) continue;
    for (Json& object : json[key]) removeExtension(object, "EXT_meshopt_compression");
  }
  forEachPrimitive(json, [](Json& primitive) { removeExtension(primitive, "KHR_draco_mesh_compression"); });
  removeName(json, "extensionsUsed", "EXT_meshopt_compression");
  removeName(json, "extensionsUsed", "KHR_draco_mesh_compression");
}

}  // namespace lucarne
