#include "player/frustum.h"

#include <algorithm>
#include <cmath>

namespace lucarne {

Frustum::Frustum(const Camera& camera, double aspect) : eye_(camera.position) {
  constexpr double kRoom = 1.02;
  const double y = kRoom * std::tan(camera.yfov / 2), x = y * aspect;
  const Vec3d ahead = -camera.back;
  inward_ = {ahead * x + camera.right, ahead * x - camera.right, ahead * y + camera.up, ahead * y - camera.up, ahead};
}

bool Frustum::mayShow(Vec3f lower, Vec3f upper) const {
  return std::all_of(inward_.begin(), inward_.end(), [&](Vec3d n) {
    const Vec3d farthest{static_cast<double>(n.x > 0 ? upper.x : lower.x),
                         static_cast<double>(n.y > 0 ? upper.y : lower.y),
                         static_cast<double>(n.z > 0 ? upper.z : lower.z)};
    return dot(n, farthest - eye_) >= 0;
  });
}

std::vector<std::uint8_t> visibleRuns(const Frustum& frustum, const std::vector<ChartRun>& runs) {
  std::vector<std::uint8_t> visible;
  visible.reserve(runs.size());
  for (const ChartRun& run : runs) visible.push_back(frustum.mayShow(run.lower, run.upper) ? 1 : 0);
  return visible;
}

}  // namespace lucarne
