#include "app/check_surfaces.h"

#include <algorithm>
#include <tuple>

#include "app/mesh_difference.h"

namespace lucarne {
namespace {

/// By vertex of one instance: the number of the first vertex in the same place.
std::vector<std::uint32_t> joinedVertices(const Scene& scene, const PrimitiveInstance& instance) {
  std::vector<std::uint32_t> order(instance.vertexCount), joined(instance.vertexCount);
  for (std::uint32_t v = 0; v < instance.vertexCount; ++v) order[v] = v;
  const auto place = [&](std::uint32_t v) {
    const Vec3f p = scene.positions[instance.firstVertex + v] + Vec3f{};  // −0 becomes 0
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple_cat(place(a), std::tuple(a)) < std::tuple_cat(place(b), std::tuple(b));
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    joined[order[i]] = i > 0 && place(order[i]) == place(order[i - 1]) ? joined[order[i - 1]] : order[i];
  return joined;
}

struct EdgeCounts {
  std::size_t open = 0, crowded = 0;
};

EdgeCounts countEdges(const Scene& scene, const PrimitiveInstance& instance) {
  const std::vector<std::uint32_t> joined = joinedVertices(scene, instance);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::uint32_t t = instance.firstTriangle; t < instance.firstTriangle + instance.triangleCount; ++t) {
    if (!scene.skipped.empty() && scene.skipped[t] != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = joined[scene.triangles[t].v[k] - instance.firstVertex],
                          b = joined[scene.triangles[t].v[(k + 1) % 3] - instance.firstVertex];
      if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::sort(edges.begin(), edges.end());
  EdgeCounts counts;
  for (auto at = edges.begin(); at != edges.end();) {
    const auto end = std::find_if(at, edges.end(), [&](const auto& e) { return e != *at; });
    if (end - at == 1) ++counts.open;
    if (end - at > 2) ++counts.crowded;
    at = end;
  }
  return counts;
}

/// Primitives of one mesh are cut by material, so that an open one may close with its neighbours; each is looked at by
/// itself all the same, since a material decides what is seen from behind.
struct OpenMesh {
  const PrimitiveInstance* instance;
  std::size_t edges;
};

}  // namespace

nlohmann::json checkSurfaces(const Scene& scene) {
  constexpr std::size_t kMost = 20;
  std::vector<OpenMesh> open;
  std::size_t crowded = 0, oneSided = 0;
  const auto material = [&](const PrimitiveInstance& i) -> const Material& {
    return scene.materials[scene.triangles[i.firstTriangle].material];
  };
  const auto black = [&](const PrimitiveInstance& i) { return !material(i).doubleSided && !material(i).transmits(); };
  std::size_t meshes = 0;
  for (const PrimitiveInstance& i : scene.instances) {
    if (i.triangleCount == 0) continue;
    ++meshes;
    const EdgeCounts edges = countEdges(scene, i);
    crowded += edges.crowded;
    if (edges.open == 0) continue;
    open.push_back({&i, edges.open});
    oneSided += black(i) ? 1 : 0;
  }
  std::stable_sort(open.begin(), open.end(), [](const OpenMesh& a, const OpenMesh& b) { return a.edges > b.edges; });
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < std::min(kMost, open.size()); ++i) {
    const PrimitiveInstance& instance = *open[i].instance;
    list.push_back({{"name", meshName(scene, instance)},
                    {"material", material(instance).name},
                    {"triangles", instance.triangleCount},
                    {"open_edges", open[i].edges},
                    {"one_sided", black(instance)}});
  }
  return {{"meshes", meshes},           {"closed", meshes - open.size()}, {"open", open.size()},
          {"one_sided_open", oneSided}, {"crowded_edges", crowded},       {"list", list}};
}

}  // namespace lucarne
