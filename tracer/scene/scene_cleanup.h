// Triangles that are in the file and yet no surface of their own: without area, or there a second time.
#pragma once

#include "tracer/scene/scene.h"

namespace lucarne {

/// Whether rounding decides which way the triangle faces: its height over its longest edge is below 1e-10 of that edge.
bool hasNoArea(const Scene& scene, std::uint32_t triangle);

/// What markSkipped() found; scenes that it has not seen are asked for their areas.
inline bool isSkipped(const Scene& scene, std::uint32_t triangle) {
  return scene.skipped.empty() ? hasNoArea(scene, triangle) : scene.skipped[triangle] != 0;
}

/// Fills Scene::skipped and its two counts from positions and triangles, for all instances together. The first of equal
/// triangles stays. Equal are those whose corners are, bit for bit but for the sign of zero, in the same cyclic order;
/// the two faces of a wall are not. Time and memory are proportional to the number of triangles.
void markSkipped(Scene& scene);

}  // namespace lucarne
