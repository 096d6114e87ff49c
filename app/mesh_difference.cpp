#include "app/mesh_difference.h"

#include <algorithm>

#include "app/check_input.h"
#include "app/named_pairs.h"
#include "app/unpaired.h"
#include "base/units.h"
#include "tracer/scene/gltf_source.h"
#include "tracer/scene/light_hash.h"

namespace lucarne {
namespace {

struct NamedInstance {
  std::string name;
  const PrimitiveInstance* instance;
};

/// "name" of an element of a list of the document; empty where there is none.
std::string documentName(const Scene& scene, const char* list, std::uint32_t index) {
  if (scene.source == nullptr) return {};
  const auto& elements = scene.source->list(list);
  if (index >= elements.size() || !elements[index].contains("name") || !elements[index]["name"].is_string()) return {};
  return elements[index]["name"].get<std::string>();
}

std::vector<NamedInstance> instancesOf(const Scene& scene) {
  std::vector<NamedInstance> list;
  for (const PrimitiveInstance& i : scene.instances) list.push_back({meshName(scene, i), &i});
  return list;
}

std::vector<const NamedInstance*> pointersTo(const std::vector<NamedInstance>& list) {
  std::vector<const NamedInstance*> pointers;
  for (const NamedInstance& i : list) pointers.push_back(&i);
  return pointers;
}

/// True where corresponding elements of the two instances' vertices differ; lists that one scene lacks differ.
template <class T, class Differ>
bool anyVertex(const std::vector<T>& a, const PrimitiveInstance& i, const std::vector<T>& b, const PrimitiveInstance& j,
               const Differ& differ) {
  if (a.empty() && b.empty()) return false;
  if (a.empty() || b.empty()) return true;
  for (std::uint32_t v = 0; v < i.vertexCount; ++v)
    if (differ(a[i.firstVertex + v], b[j.firstVertex + v])) return true;
  return false;
}

bool sameTriangles(const Scene& a, const PrimitiveInstance& i, const Scene& b, const PrimitiveInstance& j) {
  for (std::uint32_t t = 0; t < i.triangleCount; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (a.triangles[i.firstTriangle + t].v[k] - i.firstVertex !=
          b.triangles[j.firstTriangle + t].v[k] - j.firstVertex)
        return false;
  return true;
}

const Material& materialOf(const Scene& scene, const PrimitiveInstance& i) {
  return scene.materials[scene.triangles[i.firstTriangle].material];
}

/// Of another name, and not only that.
bool otherMaterial(const Scene& a, const Material& m, const Scene& b, const Material& n) {
  return m.name != n.name && lightHash(a, m) != lightHash(b, n);
}

/// Positions of two frames agree when they do so to single precision, in metres.
bool moved(const Scene& a, const PrimitiveInstance& i, const Scene& b, const PrimitiveInstance& j) {
  const double least = 1e-6 * std::max(a.frame.scale, b.frame.scale);
  const bool oneFrame = a.frame.scale == b.frame.scale && a.frame.origin == b.frame.origin;
  return anyVertex(a.positions, i, b.positions, j, [&](Vec3f p, Vec3f q) {
    if (oneFrame) return p != q;
    return length(a.frame.toWorld(Vec3d(p)) - b.frame.toWorld(Vec3d(q))) > least;
  });
}

void compare(const Scene& a, const Scene& b, const NamedInstance& first, const NamedInstance& second,
             std::vector<std::string>& list) {
  const PrimitiveInstance &i = *first.instance, &j = *second.instance;
  const std::string what = "mesh " + quotedName(first.name) + ": ";
  if (i.triangleCount != j.triangleCount || i.vertexCount != j.vertexCount || !sameTriangles(a, i, b, j)) {
    list.push_back(what + (i.triangleCount == j.triangleCount
                               ? std::string("other triangles")
                               : formatCount(i.triangleCount) + " → " + formatCount(j.triangleCount) + " triangles"));
    return;
  }
  const auto unequal = [](const auto& p, const auto& q) { return !(p == q); };
  if (moved(a, i, b, j)) list.push_back(what + "vertices moved");
  if (anyVertex(a.normals, i, b.normals, j, unequal)) list.push_back(what + "other normals");
  if (anyVertex(a.uv0, i, b.uv0, j, unequal) || anyVertex(a.uv1, i, b.uv1, j, unequal))
    list.push_back(what + "other texture coordinates");
  if (anyVertex(a.atlasUv, i, b.atlasUv, j, unequal)) list.push_back(what + "another unwrapping (TEXCOORD_1)");
  if (i.triangleCount > 0 && otherMaterial(a, materialOf(a, i), b, materialOf(b, j)))
    list.push_back(what + "material " + quotedName(materialOf(a, i).name) + " → " + quotedName(materialOf(b, j).name));
  if (i.texelsPerMetre != j.texelsPerMetre)
    list.push_back(what + "texels per metre " + formatNumber(i.texelsPerMetre) + " → " +
                   formatNumber(j.texelsPerMetre));
}

}  // namespace

std::string meshName(const Scene& scene, const PrimitiveInstance& instance) {
  std::string name = documentName(scene, "meshes", instance.mesh);
  if (name.empty()) name = documentName(scene, "nodes", instance.node);
  return name.empty() ? "mesh " + std::to_string(instance.mesh) : name;
}

void addMeshDifferences(const Scene& before, const Scene& after, std::vector<std::string>& list) {
  const std::vector<NamedInstance> a = instancesOf(before), b = instancesOf(after);
  Unpaired<NamedInstance> unpaired;
  forNamedPairs(pointersTo(a), pointersTo(b), [&](const NamedInstance* i, const NamedInstance* j) {
    if (i != nullptr && j != nullptr) return compare(before, after, *i, *j, list);
    unpaired.add(i, j);
  });
  unpaired.tell(
      "mesh",
      [&](const NamedInstance& i, const NamedInstance& j) {
        std::vector<std::string> none;
        compare(before, after, i, j, none);
        return none.empty();
      },
      list);
}

}  // namespace lucarne
