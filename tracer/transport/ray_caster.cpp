#include "tracer/transport/ray_caster.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "tracer/optics/surface.h"
#include "tracer/scene/scene_cleanup.h"
#include "tracer/transport/clearance.h"

namespace lucarne {
namespace {

constexpr int kMostRepeats = 4;

std::string defaultIsa() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? "avx2" : "sse4.2";
#else
  return {};
#endif
}

[[noreturn]] void failWith(RTCDevice device, const std::string& what) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw Error(ExitCode::outOfResource, "out of memory while " + what);
  throw Error(ExitCode::failed,
              "Embree failed while " + what + " (error " + std::to_string(static_cast<int>(code)) + ")");
}

RTCRayHit rayHit(Vec3f origin, Vec3f direction, float tnear) {
  RTCRayHit r;
  r.ray.org_x = origin.x;
  r.ray.org_y = origin.y;
  r.ray.org_z = origin.z;
  r.ray.dir_x = direction.x;
  r.ray.dir_y = direction.y;
  r.ray.dir_z = direction.z;
  r.ray.tnear = tnear;
  r.ray.tfar = std::numeric_limits<float>::infinity();
  r.ray.time = 0;
  r.ray.mask = 0xffffffffu;
  r.ray.flags = 0;
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

void castRay(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
#endif
}

/// The barycentric coordinate that keeps `distance` from every edge: distance / smallest height, which is twice the
/// area over the longest edge. At most ¼, so that something is left of a needle.
float insetOf(Vec3f e1, Vec3f e2, double twiceArea, double distance) {
  const double longest = static_cast<double>(std::max({length(e1), length(e2), length(e2 - e1)}));
  return static_cast<float>(std::min(distance * longest, 0.25 * twiceArea) / std::max(twiceArea, 1e-300));
}

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
constexpr RTCSceneFlags kRaysHaveFilters = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using EmbreeContext = RTCIntersectContext;
constexpr RTCSceneFlags kRaysHaveFilters = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

RTCSceneFlags sceneFlags(bool robust, bool filters) {
  return static_cast<RTCSceneFlags>((robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                                    (filters ? kRaysHaveFilters : RTC_SCENE_FLAG_NONE));
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, const RayCasterOptions& options, const SurfaceTable* surfaces)
    : isa_(options.isa.empty() ? defaultIsa() : options.isa) {
  build(scene, options, surfaces);
  description_ = std::string("Embree ") + RTC_VERSION_STRING + (isa_.empty() ? "" : ", " + isa_) +
                 (options.robust ? ", robust" : ", fast");
}

RayCaster::~RayCaster() {
  if (embreeScene_ != nullptr) rtcReleaseScene(embreeScene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

void RayCaster::build(const Scene& scene, const RayCasterOptions& options, const SurfaceTable* surfaces) {
  device_ = rtcNewDevice(isa_.empty() ? nullptr : ("isa=" + isa_).c_str());
  if (device_ == nullptr) failWith(nullptr, "starting with isa=" + isa_);
  embreeScene_ = rtcNewScene(device_);
  rtcSetSceneBuildQuality(embreeScene_, RTC_BUILD_QUALITY_MEDIUM);
  anyHoles_ = surfaces != nullptr && surfaces->features().holes;
  rtcSetSceneFlags(embreeScene_, sceneFlags(options.robust, anyHoles_));
  const std::size_t n = scene.triangles.size();
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), scene.positions.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), n));
  if (vertices == nullptr || indices == nullptr) failWith(device_, "copying the triangles");
  for (const Vec3f& p : scene.positions) {
    *vertices++ = p.x;
    *vertices++ = p.y;
    *vertices++ = p.z;
  }
  triangles_.reserve(n);
  const Clearances clearances(scene);
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool skipped = isSkipped(scene, i);  // three times one corner: no ray meets it
    for (const std::uint32_t v : scene.triangles[i].v) *indices++ = skipped ? scene.triangles[i].v[0] : v;
    const Vec3d scaled = scene.scaledNormal(i);
    const Vec3f e1 = scene.corner(i, 1) - scene.corner(i, 0), e2 = scene.corner(i, 2) - scene.corner(i, 0);
    const float clearance = clearances.of(i);
    TriangleData t{scene.corner(i, 0), e1, e2, Vec3f(normalize(scaled)), 0, 0, 0, 0, clearance};
    t.material = scene.triangles[i].material & 0x3fffffffu;
    t.holes = surfaces != nullptr && surfaces->hasHoles(scene.triangles[i].material);
    t.smooth = !scene.smooth.empty() && scene.smooth[i] != 0;
    t.inset = insetOf(e1, e2, length(scaled), static_cast<double>(clearance));
    triangles_.push_back(t);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embreeScene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embreeScene_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) failWith(device_, "building the ray tracing structure");
  RTCBounds bounds;
  rtcGetSceneBounds(embreeScene_, &bounds);
  lower_ = {bounds.lower_x, bounds.lower_y, bounds.lower_z};
  upper_ = {bounds.upper_x, bounds.upper_y, bounds.upper_z};
  closed_ = isClosed();
}

/// A ray on its way through Embree.
struct RayCaster::Question {
  EmbreeContext context;  // first: Embree hands it to the filter
  const RayCaster& caster;
  Vec3f origin, direction;
  std::uint32_t from;
  const HoleQuestion& holes;
};

void RayCaster::filter(const RTCFilterFunctionNArguments* arguments) {
  const Question& q = *reinterpret_cast<const Question*>(arguments->context);
  const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
  const bool passes = triangle == q.from || (q.caster.triangles_[triangle].holes != 0 &&
                                             q.holes.goesThrough(q.caster.intersect(triangle, q.origin, q.direction)));
  if (passes) arguments->valid[0] = 0;
}

std::uint32_t RayCaster::castThroughHoles(Question& question, float tnear) const {
  RTCRayHit ray = rayHit(question.origin, question.direction, tnear);
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&question.context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &question.context;
  arguments.filter = &RayCaster::filter;
  arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  rtcIntersect1(embreeScene_, &ray, &arguments);
#else
  rtcInitIntersectContext(&question.context);
  question.context.filter = &RayCaster::filter;
  rtcIntersect1(embreeScene_, &question.context, &ray);
#endif
  return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kNone : ray.hit.primID;
}

std::uint32_t RayCaster::cast(Vec3f origin, Vec3f direction, float tnear, std::uint32_t from, std::uint64_t& repeats,
                              const HoleQuestion* holes) const {
  if (holes != nullptr && anyHoles_) {
    Question question{{}, *this, origin, direction, from, *holes};
    return castThroughHoles(question, tnear);
  }
  for (int attempt = 0; attempt < kMostRepeats; ++attempt) {
    RTCRayHit ray = rayHit(origin, direction, tnear);
    castRay(embreeScene_, ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kNone;
    if (ray.hit.primID != from) return ray.hit.primID;
    ++repeats;  // a plane cannot be met twice: rounding. Go on behind it.
    tnear = ray.ray.tfar * (1 + 0x1p-22f) + 0x1p-24f;
  }
  return kNone;
}

std::uint32_t RayCaster::nearest(Vec3f origin, Vec3f direction, std::uint32_t from, std::uint64_t& repeats,
                                 const HoleQuestion* holes) const {
  const std::uint32_t met = cast(origin, direction, 0, from, repeats, holes);
  if (met != kNone || !closed_) [[likely]]
    return met;
  return castAgain(origin, direction, from, repeats, holes);
}

/// Of a ray that met nothing in a closed scene. Embree's robust mode is watertight at edges. At a corner its edge tests
/// may round so that none of the triangles around is met, by about one ray in a thousand that is aimed at the very
/// corner; turned by a few roundings it meets one. And in the tip of a spike, where walls are nearer to each other than
/// rays start from them, a ray may have started beyond the other wall; from the very triangle it meets that wall.
[[gnu::noinline]] std::uint32_t RayCaster::castAgain(Vec3f origin, Vec3f direction, std::uint32_t from,
                                                     std::uint64_t& repeats, const HoleQuestion* holes) const {
  if (isWithinBounds(origin)) {
    const Vec3f turned = direction + Frame<float>(direction).s * 0x1p-19f;
    const std::uint32_t met = cast(origin, turned, 0, from, repeats, holes);
    if (met != kNone) return met;
  }
  if (from == kNone) return kNone;
  const TriangleData& t = triangles_[from];
  const float above = dot(t.n, direction) > 0 ? t.clearance : -t.clearance;
  return cast(origin - t.n * above, direction, 0, from, repeats, holes);
}

bool RayCaster::isWithinBounds(Vec3f p) const {
  return p.x >= lower_.x && p.y >= lower_.y && p.z >= lower_.z && p.x <= upper_.x && p.y <= upper_.y && p.z <= upper_.z;
}

/// Where light leaves a scene, casting each ray that does so a second time would cost up to a quarter of all time (of a
/// room without a wall), for the sake of rays that hardly ever are: those aimed at a corner to the last bit. So only
/// scenes do it of which at most one in 64 rays finds a way out, from fronts picked by their numbers, in directions
/// with the density of the cosine: a spiral over the sphere about the tip of the normal.
bool RayCaster::isClosed() const {
  constexpr std::size_t kRays = 512;
  std::size_t tried = 0, lost = 0;
  std::uint64_t repeats = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    const auto triangle = static_cast<std::uint32_t>(i * triangles_.size() / kRays);
    const TriangleData& t = triangles_[triangle];
    if (!(t.clearance > 0)) continue;  // skipped
    const double z = 1 - (2 * static_cast<double>(i * 197 % kRays) + 1) / kRays, r = std::sqrt(1 - z * z);
    const double phi = 2.399963229728653 * static_cast<double>(i);
    const Vec3d direction = normalize(Vec3d(t.n) + Vec3d{r * std::cos(phi), r * std::sin(phi), z});
    const Vec3d middle = Vec3d(t.p0) + (Vec3d(t.e1) + Vec3d(t.e2)) * (1.0 / 3);
    ++tried;
    lost += cast(leave(middle, t.n, t.clearance), Vec3f(direction), 0, triangle, repeats, nullptr) == kNone;
  }
  return 64 * lost <= tried;
}

std::uint32_t RayCaster::past(std::uint32_t met, Vec3f origin, Vec3f direction, std::uint32_t from,
                              std::uint64_t& repeats, const HoleQuestion* holes) const {
  Hit hit = intersect(met, origin, direction);
  for (int attempt = 0; attempt < kMostRepeats && startsOn(hit, origin, from); ++attempt) {
    if (attempt > 0 && !hit.back) break;
    const auto t = static_cast<float>(std::max(0.0, dot(hit.position - Vec3d(origin), Vec3d(direction))));
    const std::uint32_t next = cast(origin, direction, t * (1 + 0x1p-18f) + hit.clearance, from, repeats, holes);
    if (next == kNone) return kNone;
    hit = intersect(next, origin, direction);
  }
  return hit.back ? frontOn(hit, origin, direction, holes) : hit.triangle;
}

/// Looks for the front that a ray meets which Embree said to meet a back. The triangle with the smallest index, so that
/// the answer does not depend on the order of Embree's tree.
///
/// A front that lies where the back was met is one. So is a front over the edge of a ridge: a ray that passes within a
/// rounding c of the edge is given the one or the other, and where it meets the back it is up to c / |cos| from the
/// edge, cos that of the ray and the back's normal, and c · |cos of the front| / |cos| below the front's plane. Only
/// over ridges: where the two are a room's outer edge, seen from outside, the ray does meet the back first.
struct RayCaster::FrontSearch {
  const RayCaster& caster;
  const Hit& back;
  Vec3f origin, direction;
  const HoleQuestion* holes;
  double touching, grazing;  // c; 1 / |cos|
  std::uint32_t found = kNone;

  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    FrontSearch& self = *static_cast<FrontSearch*>(arguments->userPtr);
    const std::uint32_t i = arguments->primID;
    if (i < self.found && self.isMet(i)) self.found = i;
    return false;  // the radius stays
  }
  bool isMet(std::uint32_t i) const {
    const TriangleData& t = caster.triangles_[i];
    const auto cosine = static_cast<double>(dot(t.n, direction));
    if (!(cosine < 0)) return false;
    const Hit foot = caster.intersect(i, Vec3f(back.position + Vec3d(t.n)), -t.n);
    const double apart = length(foot.position - back.position);
    if (apart > touching && !(apart <= touching * (1 + grazing) && isAtRidge(t, -cosine))) return false;
    return holes == nullptr || t.holes == 0 || !holes->goesThrough(caster.intersect(i, origin, direction));
  }
  bool isAtRidge(const TriangleData& front, double cosine) const {
    const double below = std::abs(dot(back.position - Vec3d(front.p0), Vec3d(front.n)));
    const TriangleData& own = caster.triangles_[back.triangle];
    return below <= touching * (1 + cosine * grazing) && isBehind(own, front) && isBehind(front, own);
  }
  /// All of a is behind the plane of b's front, or in it.
  bool isBehind(const TriangleData& a, const TriangleData& b) const {
    const auto above = [&](Vec3d p) { return dot(p - Vec3d(b.p0), Vec3d(b.n)) > touching; };
    const Vec3d p0(a.p0);
    return !above(p0) && !above(p0 + Vec3d(a.e1)) && !above(p0 + Vec3d(a.e2));
  }
};

std::uint32_t RayCaster::frontOn(const Hit& back, Vec3f origin, Vec3f direction, const HoleQuestion* holes) const {
  constexpr double kMostGrazing = 0x1p10;
  const double touching = 2 * static_cast<double>(back.clearance);
  const double grazing = std::min(1 / std::abs(static_cast<double>(dot(back.n, direction))), kMostGrazing);
  FrontSearch search{*this, back, origin, direction, holes, touching, grazing};
  const Vec3f place(back.position);
  RTCPointQuery query{place.x, place.y, place.z, 0, static_cast<float>(touching * (1 + grazing))};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(embreeScene_, &query, &context, &FrontSearch::visit, &search);
  return search.found != kNone ? search.found : back.triangle;
}

}  // namespace lucarne
