// The next surface along a ray, as light meets it: through holes, and with touching triangles told apart.
#pragma once

#include "tracer/optics/sampler.h"
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

/// HoleQuestion by a function.
template <class GoesThrough>
class HoleAnswer final : public HoleQuestion {
 public:
  explicit HoleAnswer(const GoesThrough& answer) : answer_(answer) {}
  bool goesThrough(const Hit& hit) const override { return answer_(hit); }

 private:
  const GoesThrough& answer_;
};

/// False where there is nothing. `found(triangle)` is called once, early, with what the ray comes to first.
/// `goesThrough(hit)` is asked at surfaces with holes, if `holes`; see HoleQuestion. `repeats`: see
/// RayCaster::nearest().
template <bool holes, class Found, class GoesThrough>
[[gnu::always_inline]] inline bool meetSurface(const PhotonScene& scene, const RayStart& ray, std::uint64_t& repeats,
                                               Found&& found, const GoesThrough& goesThrough, Hit& hit) {
  const RayCaster& caster = scene.rayCaster();
  // A lamp on a two-sided surface shines to both sides of it.
  const auto lampOn = [&] {
    return ray.from == kNone && scene.surfaces().twoSided(hit.material) && caster.startsOn(hit, ray.origin, kNone);
  };
  const HoleAnswer<GoesThrough> answer(goesThrough);
  const HoleQuestion* question = holes ? &answer : nullptr;
  const std::uint32_t triangle = caster.nearest(ray.origin, ray.direction, ray.from, repeats, question);
  if (triangle == kNone) return false;
  caster.prefetch(triangle);
  found(triangle);
  hit = caster.intersect(triangle, ray.origin, ray.direction);
  if (!(isBlackBack(scene, hit) || lampOn())) [[likely]]
    return true;
  const std::uint32_t next = caster.past(triangle, ray.origin, ray.direction, ray.from, repeats, question);
  if (next == kNone) return false;
  if (next != triangle) hit = caster.intersect(next, ray.origin, ray.direction);
  return true;
}

/// A choice of goesThrough(): alpha is the probability that the ray meets the surface. The number is one of (photon,
/// event, triangle), in whatever order the triangles are asked about.
template <class Sampler>
bool goesThroughByChance(const SurfaceTable& surfaces, const Hit& hit, const Sampler& sampler, std::uint32_t event) {
  const float coverage = surfaces.coverage(placeOf(hit), hit.back);
  if (coverage <= 0 || coverage >= 1) return coverage <= 0;
  const std::uint64_t key = mix64(std::uint64_t{hit.triangle} << 32 | event);
  return toUnitFloat(sampler.words(static_cast<std::uint32_t>(key >> 32), Stream::coverage)[0]) >= coverage;
}

}  // namespace lucarne
