#include "tracer/transport/clearance.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {

float longestEdge(const Scene& scene, std::uint32_t i) {
  const Vec3f a = scene.corner(i, 0), b = scene.corner(i, 1), c = scene.corner(i, 2);
  return std::max({length(b - a), length(c - b), length(a - c)});
}

std::uint64_t hashOf(Vec3f p) {
  std::uint64_t h = 0;
  for (int i = 0; i < 3; ++i) {
    h = (h ^ std::bit_cast<std::uint32_t>(p[i] + 0.f)) * 0x9e3779b97f4a7c15u;  // + 0: −0 is 0
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

Clearances::Clearances(const Scene& scene) : scene_(scene), slots_(std::bit_ceil(2 * scene.positions.size() + 1)) {
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    if (isSkipped(scene, i)) continue;
    const float edge = longestEdge(scene, i);
    for (const std::uint32_t v : scene.triangles[i].v) {
      Slot& slot = slots_[slotOf(scene.positions[v])];
      slot.vertex = v;
      slot.longest = std::max(slot.longest, edge);
    }
  }
}

/// The slot of the place, or the free one where it would be.
std::size_t Clearances::slotOf(Vec3f place) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hashOf(place) & mask;
  while (slots_[i].vertex != kNone && scene_.positions[slots_[i].vertex] != place) i = (i + 1) & mask;
  return i;
}

/// The origin of a ray is rounded to float: off by at most 2^-25 of each coordinate, √3·2^-25·M along the normal, with
/// M the largest coordinate. Embree finds the side of a plane from dot(v0 − origin, n), with an error of about 3·2^-24
/// of the distance to v0: at most the longest edge L of the triangles around, for those that lie in the same plane.
/// Hence 2^-24·(2M + 3L); twice that is used.
float Clearances::of(std::uint32_t triangle) const {
  if (isSkipped(scene_, triangle)) return 0;
  float largest = 0, longest = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3f p = scene_.corner(triangle, k);
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    longest = std::max(longest, slots_[slotOf(p)].longest);
  }
  return 0x1p-24f * (4 * largest + 6 * longest);
}

}  // namespace lucarne
