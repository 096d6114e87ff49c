// An Embree scene whose intersection filter lets light through masked and blended surfaces: one ray finds the first
// triangle that light meets. Triangles without holes lie in a geometry without filter, which the tracer does not do.
// For alpha_study.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <limits>
#include <vector>

#include "tracer/transport/meet.h"

namespace lucarne::study {

/// A segment of a path.
struct Ray {
  RayStart start;
  std::uint64_t key;  // of (photon, event)
};

inline float unitHash(std::uint64_t key) { return toUnitFloat(static_cast<std::uint32_t>(mix64(key) >> 32)); }

/// Does not depend on when it is asked.
inline bool goesThrough(const SurfaceTable& surfaces, const Hit& hit, std::uint64_t key) {
  const float coverage = surfaces.coverage(placeOf(hit), hit.back);
  if (coverage >= 1) return false;
  return coverage <= 0 || unitHash(key + hit.triangle * 0xD1342543DE82EF95u) >= coverage;
}

/// The triangle is what it gives; places are recomputed in double by RayCaster, in the filter too.
class FilterCaster {
 public:
  explicit FilterCaster(const PhotonScene& scene)
      : photonScene_(scene),
        device_(rtcNewDevice(("isa=" + scene.rayCaster().isa()).c_str())),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (std::uint32_t i = 0; i < scene.scene().triangles.size(); ++i)
      triangles_[scene.surfaces().hasHoles(scene.scene().triangles[i].material)].push_back(i);
    for (const bool filtered : {false, true}) attach(filtered);
    rtcCommitScene(scene_);
  }
  ~FilterCaster() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  FilterCaster(const FilterCaster&) = delete;
  FilterCaster& operator=(const FilterCaster&) = delete;

  /// The nearest triangle that light does not go through. `asked` counts the calls of the filter.
  std::uint32_t nearest(const Ray& ray, std::uint64_t& asked) const {
    const Vec3f o = ray.start.origin, d = ray.start.direction;
    Question question{{}, *this, ray, asked};
    RTCRayHit r;
    r.ray = {o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, 0, 0xffffffffu, 0, 0};
    constexpr int kMostRepeats = 4;  // as in RayCaster
    for (int attempt = 0; attempt < kMostRepeats; ++attempt) {
      r.ray.tfar = std::numeric_limits<float>::infinity();
      r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      question.cast(scene_, r);
      if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNone;
      const std::uint32_t triangle = triangles_[r.hit.geomID][r.hit.primID];
      if (triangle != ray.start.from) return triangle;
      r.ray.tnear = r.ray.tfar * (1 + 0x1p-22f) + 0x1p-24f;
    }
    return kNone;
  }

 private:
#if RTC_VERSION_MAJOR >= 4
  using Context = RTCRayQueryContext;
#else
  using Context = RTCIntersectContext;
#endif
  struct Question {
    Context context;  // first: Embree hands it to the filter
    const FilterCaster& caster;
    const Ray& ray;
    std::uint64_t& asked;

    void cast(RTCScene scene, RTCRayHit& r) {
#if RTC_VERSION_MAJOR >= 4
      rtcInitRayQueryContext(&context);
      RTCIntersectArguments arguments;
      rtcInitIntersectArguments(&arguments);
      arguments.context = &context;
      rtcIntersect1(scene, &r, &arguments);
#else
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene, &context, &r);
#endif
    }
  };

  static void filter(const RTCFilterFunctionNArguments* arguments) {
    const Question& q = *reinterpret_cast<const Question*>(arguments->context);
    const PhotonScene& scene = q.caster.photonScene_;
    const std::uint32_t triangle = q.caster.triangles_[1][RTCHitN_primID(arguments->hit, arguments->N, 0)];
    ++q.asked;
    if (triangle == q.ray.start.from ||
        goesThrough(scene.surfaces(), scene.rayCaster().intersect(triangle, q.ray.start.origin, q.ray.start.direction),
                    q.ray.key))
      arguments->valid[0] = 0;
  }

  void attach(bool filtered) {
    const Scene& scene = photonScene_.scene();
    const std::size_t count = triangles_[filtered].size();
    if (count == 0) return;  // an empty geometry with a filter costs, too
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* p = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* v = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                  3 * sizeof(std::uint32_t), count));
    for (std::uint32_t i = 0; i < 3 * count; ++i) {
      const Vec3f corner = scene.corner(triangles_[filtered][i / 3], static_cast<int>(i % 3));
      for (int axis = 0; axis < 3; ++axis) *p++ = corner[axis];
      *v++ = i;
    }
    if (filtered) rtcSetGeometryIntersectFilterFunction(geometry, &FilterCaster::filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, filtered);
    rtcReleaseGeometry(geometry);
  }

  const PhotonScene& photonScene_;
  RTCDevice device_;
  RTCScene scene_;
  std::array<std::vector<std::uint32_t>, 2> triangles_;  // by geometry: without and with filter
};

}  // namespace lucarne::study
