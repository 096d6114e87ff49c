#include "tracer/scene/gltf_tangents.h"

#include <algorithm>
#include <cmath>

#include "tracer/scene/tangent_space.h"

namespace lucarne {
namespace {

/// Tangents lie in the surface, so they go with the linear part itself: t' = M t. The bitangent is M (n × t) w, and
/// M n' × M t has its direction times the sign of the determinant (gltf_geometry keeps normals on the front's side).
Vec4f worldTangent(const Accessor& tangents, std::uint32_t source, const Affine& linear, bool mirrors, Vec3f normal) {
  const Vec3d own{tangents.value(source, 0), tangents.value(source, 1), tangents.value(source, 2)};
  Vec4f result = anyTangent(normal);
  const double size = std::max({std::fabs(own.x), std::fabs(own.y), std::fabs(own.z)});
  if (size > 0 && isFinite(own)) {
    const Vec3f t(inPlane(linear.vector(own / size), normal));
    if (t != Vec3f{}) result = {t.x, t.y, t.z, 1};
  }
  result.w = (tangents.value(source, 3) < 0) != mirrors ? -1.f : 1.f;
  return result;
}

}  // namespace

void readTangents(const Accessor& tangents, const WorldNode& node, Scene& scene) {
  fillTangents(scene);
  const Affine linear = balanced(node.world);
  const PrimitiveInstance& instance = scene.instances.back();
  for (std::uint32_t v = instance.firstVertex; v < instance.firstVertex + instance.vertexCount; ++v) {
    scene.tangents[v] = worldTangent(tangents, scene.sourceVertex[v], linear, node.mirrors, scene.normals[v]);
  }
}

}  // namespace lucarne
