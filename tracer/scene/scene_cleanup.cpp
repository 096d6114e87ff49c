#include "tracer/scene/scene_cleanup.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lucarne {
namespace {

using Corners = std::array<Vec3f, 3>;

bool less(Vec3f a, Vec3f b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The corners in their order, from the least of them on. Unique where they are three points.
Corners fromLeast(const Scene& scene, std::uint32_t t) {
  Corners c = {scene.corner(t, 0), scene.corner(t, 1), scene.corner(t, 2)};
  std::rotate(c.begin(), std::min_element(c.begin(), c.end(), less), c.end());
  return c;
}

std::uint64_t hashOf(const Corners& corners) {
  std::uint64_t h = 0;
  for (const Vec3f& p : corners) {
    for (int i = 0; i < 3; ++i) {
      h = (h ^ std::bit_cast<std::uint32_t>(p[i] + 0.f)) * 0x9e3779b97f4a7c15u;  // + 0: −0 is 0
      h ^= h >> 32;
    }
  }
  return h;
}

/// A set of triangles by their corners: open addressing, at most half full.
class CornerSet {
 public:
  explicit CornerSet(const Scene& scene)
      : scene_(scene), slots_(std::bit_ceil(2 * scene.triangles.size() + 1), kNone) {}

  /// False if an equal one is in the set.
  bool insert(std::uint32_t t) {
    const Corners corners = fromLeast(scene_, t);
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hashOf(corners) & mask;
    while (slots_[i] != kNone) {
      if (fromLeast(scene_, slots_[i]) == corners) return false;
      i = (i + 1) & mask;
    }
    slots_[i] = t;
    return true;
  }

 private:
  const Scene& scene_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

bool hasNoArea(const Scene& scene, std::uint32_t t) {
  const Vec3d a(scene.corner(t, 0)), b(scene.corner(t, 1)), c(scene.corner(t, 2));
  const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
  constexpr double kFlat = 1e-10;  // height over longest edge
  return !(length(scene.scaledNormal(t)) > kFlat * longest2);
}

void markSkipped(Scene& scene) {
  scene.skipped.assign(scene.triangles.size(), 0);
  scene.degenerateTriangles = scene.duplicateTriangles = 0;
  CornerSet seen(scene);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (hasNoArea(scene, t)) {
      ++scene.degenerateTriangles;
    } else if (!seen.insert(t)) {
      ++scene.duplicateTriangles;
    } else {
      continue;
    }
    scene.skipped[t] = 1;
  }
}

}  // namespace lucarne
