#include "tracer/transport/photon_scene.h"

namespace lucarne {

PhotonScene::PhotonScene(const Scene& scene, const RayCasterOptions& options, const Environment* environment)
    : scene_(scene), surfaces_(scene), emitters_(scene, surfaces_, environment), rayCaster_(scene, options, &surfaces_) {
  if (std::none_of(scene.smooth.begin(), scene.smooth.end(), [](std::uint8_t s) { return s != 0; })) return;
  cornerNormals_.reserve(scene.triangles.size());
  for (const Triangle& t : scene.triangles)
    cornerNormals_.push_back({scene.normals[t.v[0]], scene.normals[t.v[1]], scene.normals[t.v[2]]});
}

/// Tangent space is that of the front, made orthogonal to the interpolated normal at the place; the whole vector turns
/// round with it on the back, as in the glTF sample viewer.
Vec3f PhotonScene::mapped(const Hit& hit, Vec3f n, Vec3f ns) const {
  if (scene_.tangents.empty()) return ns;
  const Vec3f front = hit.back ? -ns : ns;
  const std::array<float, 3> weight{1 - hit.b.x - hit.b.y, hit.b.x, hit.b.y};
  const Triangle& triangle = scene_.triangles[hit.triangle];
  Vec3f along{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec4f t = scene_.tangents[triangle.v[k]];
    along += Vec3f{t.x, t.y, t.z} * weight[k];
  }
  const Vec3f tangent = normalize(along - front * dot(front, along));
  const Vec3f bitangent = cross(front, tangent) * scene_.tangents[triangle.v[0]].w;
  const Vec3f m = surfaces_.mapNormal({hit.material, hit.triangle, hit.b});
  const Vec3f normal = normalize(tangent * m.x + bitangent * m.y + front * m.z);
  if (normal == Vec3f{}) return ns;
  return keepInFront(hit.back ? -normal : normal, n);
}

}  // namespace lucarne
