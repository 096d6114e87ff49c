#include "tracer/scene/gltf_left_out.h"

#include <algorithm>
#include <set>

#include "tracer/scene/gltf_extensions.h"

namespace lucarne {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::vector<const Json*> usedMaterials(const GltfSource& source, const Scene& scene) {
  const Json& list = source.list("materials");
  std::vector<std::uint8_t> used(list.size() + 1, 0);
  for (const Triangle& t : scene.triangles) used[t.material] = 1;
  std::vector<const Json*> materials;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (used[i] != 0) materials.push_back(&list[i]);
  }
  return materials;
}

bool isVolumeWithoutTransmission(const Json* material) {
  const Json* extensions = findMember(*material, "extensions");
  if (extensions == nullptr || !extensions->contains("KHR_materials_volume")) return false;
  const Json* transmission = findMember(*extensions, "KHR_materials_transmission");
  const Json* factor = transmission == nullptr ? nullptr : findMember(*transmission, "transmissionFactor");
  return factor == nullptr || !(factor->get<double>() > 0);
}

void listMaterials(const std::vector<const Json*>& materials, std::vector<std::string>& out) {
  const auto add = [&](const std::string& what, const std::string& fate, const auto& has) {
    const auto count = static_cast<std::size_t>(std::count_if(materials.begin(), materials.end(), has));
    if (count > 0) out.push_back(what + " of " + counted(count, "material", "materials") + ": " + fate);
  };
  const auto member = [](const char* key) { return [key](const Json* m) { return m->contains(key); }; };
  add("occlusion maps", "ignored, light is computed instead", member("occlusionTexture"));
  add("volume without transmission", "ignored", isVolumeWithoutTransmission);
}

void listTriangles(const Scene& scene, std::vector<std::string>& out) {
  const auto add = [&](std::size_t count, const std::string& one, const std::string& many) {
    if (count > 0) out.push_back(counted(count, one, many) + ": skipped");
  };
  add(scene.degenerateTriangles, "triangle without area", "triangles without area");
  add(scene.duplicateTriangles, "duplicate triangle", "duplicate triangles");
}

struct MeshCounts {
  std::size_t pointsOrLines = 0, withoutPositions = 0, colors = 0, targets = 0, skins = 0;
};

MeshCounts countMeshes(const GltfSource& source, const std::vector<WorldNode>& nodes) {
  MeshCounts counts;
  for (const WorldNode& n : nodes) {
    const Json& node = source.list("nodes")[n.node];
    const Json* mesh = findMember(node, "mesh");
    if (mesh == nullptr) continue;
    counts.skins += node.contains("skin");
    const Json* primitives = findMember(source.list("meshes")[mesh->get<std::uint32_t>()], "primitives");
    if (primitives == nullptr) continue;
    for (const Json& p : *primitives) {
      counts.pointsOrLines += p.contains("mode") && p["mode"].get<int>() < 4;
      counts.withoutPositions += !p["attributes"].contains("POSITION");
      counts.colors += p["attributes"].contains("COLOR_0");
      counts.targets += p.contains("targets") && !p["targets"].empty();
    }
  }
  return counts;
}

void listMeshes(const MeshCounts& counts, std::vector<std::string>& out) {
  const auto add = [&](std::size_t count, const std::string& one, const std::string& many, const std::string& fate) {
    if (count > 0) out.push_back(counted(count, one, many) + ": " + fate);
  };
  add(counts.pointsOrLines, "primitive of points or lines", "primitives of points or lines", "left out");
  add(counts.withoutPositions, "primitive without positions", "primitives without positions", "left out");
  add(counts.colors, "primitive with vertex colours", "primitives with vertex colours", "the colours are ignored");
  add(counts.targets, "primitive with morph targets", "primitives with morph targets", "kept in the base shape");
  add(counts.skins, "skinned node", "skinned nodes", "kept in the pose that the mesh was modelled in");
}

void listExtensions(const GltfSource& source, const std::vector<const Json*>& materials,
                    std::vector<std::string>& out) {
  const Json* used = findMember(source.json, "extensionsUsed");
  if (used == nullptr) return;
  std::set<std::string> seen;
  for (const Json& value : *used) {
    const auto& name = value.get_ref<const std::string&>();
    if (!seen.insert(name).second) continue;
    const auto has = [&](const Json* m) { return m->contains("extensions") && (*m)["extensions"].contains(name); };
    const auto count = static_cast<std::size_t>(std::count_if(materials.begin(), materials.end(), has));
    const bool ofMaterials = name.starts_with("KHR_materials_") && name != "KHR_materials_variants";
    if (ofMaterials && count == 0) continue;
    const std::string text = extensionLeftOut(name, count);
    if (!text.empty()) out.push_back(text);
  }
}

}  // namespace

std::vector<std::string> listLeftOut(const GltfSource& source, const std::vector<WorldNode>& nodes,
                                     const Scene& scene) {
  std::vector<std::string> out;
  const std::vector<const Json*> materials = usedMaterials(source, scene);
  listMaterials(materials, out);
  listMeshes(countMeshes(source, nodes), out);
  listTriangles(scene, out);
  listExtensions(source, materials, out);
  const std::size_t animations = source.list("animations").size();
  if (animations > 0) out.push_back(counted(animations, "animation", "animations") + ": the scene stands still");
  return out;
}

}  // namespace lucarne
