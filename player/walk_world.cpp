#include "player/walk_world.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>

namespace lucarne {
namespace {

bool collect(RTCPointQueryFunctionArguments* arguments) {
  static_cast<std::vector<std::uint32_t>*>(arguments->userPtr)->push_back(arguments->primID);
  return false;  // the radius stays
}

}  // namespace

WalkWorld::WalkWorld(const Scene& scene) : frame_(scene.frame), positions_(scene.positions) {
  if (!scene.triangles.empty()) caster_.emplace(scene);
  for (const Material& m : scene.materials) doubleSided_.push_back(m.doubleSided);
  triangles_.reserve(scene.triangles.size());
  for (const Triangle& t : scene.triangles) {
    triangles_.push_back({t.v[0], t.v[1], t.v[2]});
    for (const std::uint32_t v : t.v) bounds_.add(fromLocal(Vec3d(positions_[v])));
  }
}

std::optional<WalkWorld::Surface> WalkWorld::along(Vec3d from, Vec3d direction, double reach) const {
  if (!caster_) return {};
  std::uint64_t repeats = 0;
  const Vec3f origin(toLocal(from)), way(direction);
  const std::uint32_t met = caster_->nearest(origin, way, kNone, repeats);
  if (met == kNone) return {};
  const Hit hit = caster_->intersect(met, origin, way);
  const double distance = dot(fromLocal(hit.position) - from, direction);
  if (distance > reach) return {};
  return Surface{std::max(distance, 0.0), Vec3d(hit.back ? -hit.n : hit.n), !hit.back || doubleSided_[hit.material]};
}

std::vector<WalkTriangle> WalkWorld::around(Vec3d place, double radius) const {
  if (!caster_) return {};
  std::vector<std::uint32_t> found;
  const Vec3f centre(toLocal(place));
  constexpr double kRounding = 0x1p-21;  // of the centre in single precision
  RTCPointQuery query{centre.x, centre.y, centre.z, 0, static_cast<float>(radius / frame_.scale + kRounding)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(caster_->embreeScene(), &query, &context, &collect, &found);
  std::sort(found.begin(), found.end());
  std::vector<WalkTriangle> near;
  for (const std::uint32_t i : found) {
    WalkTriangle t;
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      t.corner[k] = fromLocal(Vec3d(positions_[triangles_[i][k]]));
      box.add(t.corner[k]);
    }
    t.lo = box.lo;
    t.hi = box.hi;
    const Vec3d nearest{std::clamp(place.x, t.lo.x, t.hi.x), std::clamp(place.y, t.lo.y, t.hi.y),
                        std::clamp(place.z, t.lo.z, t.hi.z)};
    if (length(nearest - place) <= radius) near.push_back(t);
  }
  return near;
}

}  // namespace lucarne
