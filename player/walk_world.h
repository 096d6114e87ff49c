// The surfaces that a walker meets. Places are in metres from the local frame's origin ("walk space"): a power of two
// apart from the scene's local units, so that nothing is lost.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tracer/scene/scene.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

struct WalkTriangle {
  std::array<Vec3d, 3> corner;
  Vec3d lo, hi;
};

class WalkWorld {
 public:
  /// Takes what it needs of the scene, which may go afterwards. Every surface is solid, from both sides.
  explicit WalkWorld(const Scene& scene);

  struct Surface {
    double distance;
    Vec3d n;     // unit, on the side that was met
    bool front;  // the side that the material shows
  };
  /// The first surface along a unit direction, none beyond `reach`.
  std::optional<Surface> along(Vec3d from, Vec3d direction, double reach = 1e300) const;

  /// The triangles that come within `radius` of a place, in the order of the scene.
  std::vector<WalkTriangle> around(Vec3d place, double radius) const;

  const Box& bounds() const { return bounds_; }
  const LocalFrame& frame() const { return frame_; }
  Vec3d fromLocal(Vec3d local) const { return local * frame_.scale; }
  Vec3d toLocal(Vec3d place) const { return place * (1 / frame_.scale); }

 private:
  LocalFrame frame_;
  std::vector<Vec3f> positions_;  // local
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<bool> doubleSided_;    // by material
  std::optional<RayCaster> caster_;  // none without triangles
  Box bounds_;
};

}  // namespace lucarne
