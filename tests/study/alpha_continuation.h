// Light through masked and blended surfaces by going on: the nearest hit, and where light goes through, a new ray from
// behind it. For alpha_study, which weighs it against the tracer's filter.
#pragma once

#include <limits>

#include "tests/study/alpha_filter.h"

namespace lucarne::study {

/// The nearest triangle farther than `tnear`, but `from`.
inline std::uint32_t nearestBeyond(const PhotonScene& scene, const RayStart& start, float tnear, std::uint32_t from) {
  const Vec3f o = start.origin, d = start.direction;
  constexpr int kMostRepeats = 4;  // as in RayCaster
  for (int attempt = 0; attempt < kMostRepeats; ++attempt) {
    RTCRayHit r;
    r.ray = {o.x, o.y, o.z, tnear, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), 0xffffffffu, 0, 0};
    r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene.rayCaster().embreeScene(), &r);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene.rayCaster().embreeScene(), &context, &r);
#endif
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNone;
    if (r.hit.primID != from) return r.hit.primID;
    tnear = r.ray.tfar * (1 + 0x1p-22f) + 0x1p-24f;
  }
  return kNone;
}

/// `through(hit)` is told what light goes through. Triangles that touch one that light goes through count as met with
/// it: behind a decal in the plane of a floor, light gets past both.
template <class Through>
bool meetByContinuation(const PhotonScene& scene, const Ray& ray, Hit& hit, Through&& through) {
  const Vec3f o = ray.start.origin, d = ray.start.direction;
  std::uint32_t triangle = nearestBeyond(scene, ray.start, 0, ray.start.from);
  while (triangle != kNone) {
    hit = scene.rayCaster().intersect(triangle, o, d);
    if (!scene.surfaces().hasHoles(hit.material) || !goesThrough(scene.surfaces(), hit, ray.key)) return true;
    through(hit);
    const auto t = static_cast<float>(std::max(0.0, dot(hit.position - Vec3d(o), Vec3d(d))));
    triangle = nearestBeyond(scene, ray.start, t * (1 + 0x1p-20f) + hit.clearance, triangle);
  }
  return false;
}

}  // namespace lucarne::study
