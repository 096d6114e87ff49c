// What a photon needs to fly: geometry, surfaces and emitters of one scene, built once, read by all threads.
#pragma once

#include <array>
#include <vector>

#include "base/huge_allocator.h"
#include "tracer/optics/emitters.h"
#include "tracer/optics/surface.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/ray_caster.h"
#include "tracer/transport/shading_normal.h"

namespace lucarne {

class PhotonScene {
 public:
  /// `scene` and `environment` (null: none, black) must outlive this.
  explicit PhotonScene(const Scene& scene, const RayCasterOptions& options = {},
                       const Environment* environment = nullptr);
  PhotonScene(const PhotonScene&) = delete;
  PhotonScene& operator=(const PhotonScene&) = delete;

  const Scene& scene() const { return scene_; }
  const SurfaceTable& surfaces() const { return surfaces_; }
  const EmitterTable& emitters() const { return emitters_; }
  const RayCaster& rayCaster() const { return rayCaster_; }
  /// See EmitterTable::setGuide().
  void setGuide(std::size_t emitter, EmissionGuide guide) { emitters_.setGuide(emitter, std::move(guide)); }

  /// Interpolated normal on the side of `n` (the geometric normal of the side hit), or `n` itself on flat triangles.
  Vec3f shadingNormal(const Hit& hit, Vec3f n) const {
    if (!hit.smooth) return n;
    const std::array<Vec3f, 3>& corner = cornerNormals_[hit.triangle];
    const Vec3f ns = normalize(corner[0] * (1 - hit.b.x - hit.b.y) + corner[1] * hit.b.x + corner[2] * hit.b.y);
    return keepInFront(hit.back ? -ns : ns, n);
  }
  /// The same with the material's normal map; `ns` is the answer of shadingNormal().
  Vec3f mappedNormal(const Hit& hit, Vec3f n, Vec3f ns) const {
    return surfaces_.hasNormalMap(hit.material) ? mapped(hit, n, ns) : ns;
  }

 private:
  Vec3f mapped(const Hit& hit, Vec3f n, Vec3f ns) const;

  const Scene& scene_;
  SurfaceTable surfaces_;
  EmitterTable emitters_;
  RayCaster rayCaster_;
  // By triangle, side by side: one or two cache misses instead of four.
  std::vector<std::array<Vec3f, 3>, HugeAllocator<std::array<Vec3f, 3>>> cornerNormals_;
};

}  // namespace lucarne
