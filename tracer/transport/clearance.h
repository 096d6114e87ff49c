// How far off a triangle rays start that leave it.
#pragma once

#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

/// Of each triangle of a scene; what is skipped (scene_cleanup.h) counts for none.
class Clearances {
 public:
  /// `scene` must outlive this.
  explicit Clearances(const Scene& scene);
  /// Local. 0 for triangles that are skipped.
  float of(std::uint32_t triangle) const;

 private:
  struct Slot {
    std::uint32_t vertex = kNone;  // one that lies at the place
    float longest = 0;             // edge that ends there
  };
  std::size_t slotOf(Vec3f place) const;

  const Scene& scene_;
  std::vector<Slot> slots_;  // by place: open addressing, at most half full
};

}  // namespace lucarne
