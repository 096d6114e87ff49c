// What a camera can see at all.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "player/draw_list.h"
#include "tracer/scene/scene.h"

namespace lucarne {

/// The four sides of what a camera sees; nothing is far.
class Frustum {
 public:
  /// `aspect`: width over height. A pixel's worth of room is left around, for pictures shifted by less.
  Frustum(const Camera& camera, double aspect);

  /// False only if the box is certainly out of sight. Local coordinates.
  bool mayShow(Vec3f lower, Vec3f upper) const;

 private:
  Vec3d eye_;
  std::array<Vec3d, 5> inward_;  // normals of planes through the eye: four sides, and what is behind
};

/// By run of the list: 1 = may be seen.
std::vector<std::uint8_t> visibleRuns(const Frustum& frustum, const std::vector<ChartRun>& runs);

}  // namespace lucarne
