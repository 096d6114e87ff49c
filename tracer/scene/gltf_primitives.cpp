#include "tracer/scene/gltf_primitives.h"

#include <optional>

#include "tracer/scene/gltf_accessor.h"

namespace lucarne {
namespace {

enum Mode : std::uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

std::uint64_t modeOf(const Json& primitive) {
  const Json* mode = findMember(primitive, "mode");
  return mode == nullptr ? std::uint64_t{kTriangles} : mode->get<std::uint64_t>();
}

std::uint32_t accessorIndex(const Json& object, const char* key) { return object[key].get<std::uint32_t>(); }

/// Places in the index list of the corners of triangle t. In strips every second triangle is turned round, and fans
/// turn about their first vertex: the orders of the glTF specification, 3.7.2.1.
std::array<std::uint64_t, 3> cornersOf(std::uint64_t mode, std::uint64_t t) {
  if (mode == kTriangles) return {3 * t, 3 * t + 1, 3 * t + 2};
  if (mode == kFan) return {t + 1, t + 2, 0};
  return {t, t + 1 + t % 2, t + 2 - t % 2};
}

}  // namespace

const Json& primitiveJson(const GltfSource& source, std::uint32_t mesh, std::uint32_t primitive) {
  return source.list("meshes")[mesh]["primitives"][primitive];
}

Place primitivePlace(const GltfSource& source, std::uint32_t mesh, std::uint32_t primitive) {
  const std::string name = textOf(source.list("meshes")[mesh], "name", "", source.place());
  const std::string quoted = name.empty() ? "" : " \"" + name.substr(0, 60) + "\"";
  return source.place().in("meshes[" + std::to_string(mesh) + "]" + quoted).in("primitives", primitive);
}

bool hasTriangles(const Json& primitive) {
  const std::uint64_t mode = modeOf(primitive);
  return mode >= kTriangles && mode <= kFan && primitive["attributes"].contains("POSITION");
}

std::uint64_t triangleCountOf(const GltfSource& source, std::uint32_t mesh, std::uint32_t primitive) {
  const Json& json = primitiveJson(source, mesh, primitive);
  const bool indexed = json.contains("indices");
  const std::uint32_t accessor =
      indexed ? accessorIndex(json, "indices") : accessorIndex(json["attributes"], "POSITION");
  const std::uint64_t count = accessorLayout(source.list("accessors")[accessor], source.place()).count;
  return modeOf(json) == kTriangles ? count / 3 : count < 3 ? 0 : count - 2;
}

std::vector<PrimitiveUse> trianglePrimitives(const GltfSource& source, const std::vector<WorldNode>& nodes) {
  std::vector<PrimitiveUse> uses;
  std::uint64_t total = 0;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    const Json* mesh = findMember(source.list("nodes")[nodes[n].node], "mesh");
    if (mesh == nullptr) continue;
    const auto m = mesh->get<std::uint32_t>();
    const Json* primitives = findMember(source.list("meshes")[m], "primitives");
    for (std::uint32_t p = 0; primitives != nullptr && p < primitives->size(); ++p) {
      if (!hasTriangles((*primitives)[p])) continue;
      const std::uint64_t count = triangleCountOf(source, m, p);
      if (count == 0) continue;
      total += count;
      if (total > kMaxTriangles) {
        source.place().fail("has more than " + std::to_string(kMaxTriangles) + " triangles; simplify or split it");
      }
      uses.push_back({n, nodes[n].node, m, p});
    }
  }
  return uses;
}

std::vector<std::array<std::uint32_t, 3>> sourceTriangles(const GltfSource& source, std::uint32_t mesh,
                                                          std::uint32_t primitive) {
  const Json& json = primitiveJson(source, mesh, primitive);
  const std::uint64_t vertices =
      accessorLayout(source.list("accessors")[accessorIndex(json["attributes"], "POSITION")], source.place()).count;
  std::optional<Accessor> indices;
  if (json.contains("indices")) indices.emplace(source, accessorIndex(json, "indices"));
  const std::uint64_t mode = modeOf(json);
  std::vector<std::array<std::uint32_t, 3>> triangles(triangleCountOf(source, mesh, primitive));
  for (std::uint64_t t = 0; t < triangles.size(); ++t) {
    const std::array<std::uint64_t, 3> corners = cornersOf(mode, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = indices ? indices->integer(corners[k]) : static_cast<std::uint32_t>(corners[k]);
      if (v >= vertices) {
        primitivePlace(source, mesh, primitive)
            .fail("index " + std::to_string(v) + " is past its " + std::to_string(vertices) + " vertices");
      }
      triangles[t][k] = v;
    }
  }
  return triangles;
}

}  // namespace lucarne
