// The next surface along a ray, as light meets it: through holes, and with touching triangles told apart.
#pragma once

#include "tracer/transport/photon_scene.h"

namespace lucarne {

inline SurfacePlace placeOf(const Hit& hit) { return {hit.material, hit.triangle, hit.b}; }

/// Backs of one-sided triangles are opaque and black.
[[gnu::always_inline]] inline bool isBlackBack(const PhotonScene& scene, const Hit& hit) {
  return hit.back && !scene.surfaces().twoSided(hit.material);
}

/// Where a ray starts: on the triangle `from`, which it does not meet again, or kNone. Local, direction unit.
struct RayStart {
  Vec3f origin, direction;
  std::uint32_t from = kNone;
};

/// False where there is nothing. `found(triangle)` is called once, early, with what the ray comes to first.
/// `goesThrough(hit, layer)` is asked at surfaces with holes, if `holes`; `layer` counts
/// those that it went through before. `repeats`: see RayCaster::nearest().
template <bool holes, class Found, class GoesThrough>
[[gnu::always_inline]] inline bool meetSurface(const PhotonScene& scene, const RayStart& ray, std::uint64_t& repeats,
                                               Found&& found, GoesThrough&& goesThrough, Hit& hit) {
  const RayCaster& caster = scene.rayCaster();
  const SurfaceTable& surfaces = scene.surfaces();
  // A lamp on a two-sided surface shines to both sides of it.
  const auto lampOn = [&] {
    return ray.from == kNone && surfaces.twoSided(hit.material) && caster.startsOn(hit, ray.origin, kNone);
  };
  std::uint32_t triangle = caster.nearest(ray.origin, ray.direction, ray.from, repeats);
  if (triangle == kNone) return false;
  caster.prefetch(triangle);
  found(triangle);
  std::uint32_t layer = 0;
  bool toldApart = false;
  while (triangle != kNone) {
    hit = caster.intersect(triangle, ray.origin, ray.direction);
    if constexpr (holes) {
      if (surfaces.hasHoles(hit.material) && goesThrough(hit, layer)) {
        ++layer;
        triangle = caster.beyond(hit, ray.origin, ray.direction, repeats);
        continue;
      }
    }
    if (toldApart || !(isBlackBack(scene, hit) || lampOn())) [[likely]]
      return true;
    toldApart = true;
    const std::uint32_t next = caster.past(triangle, ray.origin, ray.direction, ray.from, repeats);
    if (next == triangle) return true;
    triangle = next;
  }
  return false;
}

/// A choice of goesThrough(): alpha is the probability that the ray meets the surface. `words(block)` gives four random
/// words.
template <class Words>
bool goesThroughByChance(const SurfaceTable& surfaces, const Hit& hit, std::uint32_t layer, Words&& words) {
  constexpr std::uint32_t kMostLayers = 4096;  // no scene has so many; such a surface is taken to be there
  const float coverage = surfaces.coverage(placeOf(hit), hit.back);
  if (coverage >= 1 || layer >= kMostLayers) return false;
  return coverage <= 0 || toUnitFloat(words(layer / 4)[layer % 4]) >= coverage;
}

}  // namespace lucarne
