// What a photon needs to fly: geometry, surfaces and emitters of one scene, built once, read by all threads.
#pragma once

#include <array>
#include <vector>

#include "tracer/optics/emitters.h"
#include "tracer/optics/surface.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

class PhotonScene {
 public:
  /// `scene` must outlive this.
  explicit PhotonScene(const Scene& scene, const RayCasterOptions& options = {})
      : scene_(scene), surfaces_(scene), emitters_(scene, surfaces_), rayCaster_(scene, options) {
    if (scene.smooth.empty()) return;
    for (const Triangle& t : scene.triangles)
      cornerNormals_.push_back({scene.normals[t.v[0]], scene.normals[t.v[1]], scene.normals[t.v[2]]});
  }
  PhotonScene(const PhotonScene&) = delete;
  PhotonScene& operator=(const PhotonScene&) = delete;

  const Scene& scene() const { return scene_; }
  const SurfaceTable& surfaces() const { return surfaces_; }
  const EmitterTable& emitters() const { return emitters_; }
  const RayCaster& rayCaster() const { return rayCaster_; }

  /// Interpolated shading normal on the side of `n` (the geometric normal of the side hit), or `n` itself on flat
  /// triangles and where the interpolated one turns its back on `wi`.
  Vec3f shadingNormal(const Hit& hit, Vec3f n, Vec3f wi) const {
    if (!hit.smooth) return n;
    const std::array<Vec3f, 3>& corner = cornerNormals_[hit.triangle];
    const Vec3f ns = normalize(corner[0] * (1 - hit.b.x - hit.b.y) + corner[1] * hit.b.x + corner[2] * hit.b.y);
    const Vec3f sided = hit.back ? -ns : ns;
    constexpr float kGrazing = 0.01f;
    return dot(sided, wi) > kGrazing && dot(sided, n) > kGrazing ? sided : n;
  }

 private:
  const Scene& scene_;
  SurfaceTable surfaces_;
  EmitterTable emitters_;
  RayCaster rayCaster_;
  // By triangle, side by side: one or two cache misses instead of four.
  std::vector<std::array<Vec3f, 3>> cornerNormals_;
};

}  // namespace lucarne
