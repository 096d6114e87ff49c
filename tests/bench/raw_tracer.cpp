#include "tests/bench/raw_tracer.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <limits>

#include "base/error.h"
#include "tracer/optics/warp.h"

namespace lucarne::bench {
namespace {

constexpr float kOffset = 0x1p-18f;  // hit points in single precision need more room than the tracer's

void intersect(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
#endif
}

RTCRayHit rayHit(Vec3f o, Vec3f d) {
  RTCRayHit r;
  r.ray = {o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), 0xffffffffu, 0, 0};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

}  // namespace

/// SplitMix64 (Steele, Lea, Flood 2014), two numbers of 24 bits a step.
class RawTracer::Random {
 public:
  explicit Random(std::uint64_t index) : state_(index * 0xD1342543DE82EF95ull) {}
  Vec2f pair() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    z ^= z >> 31;
    return {static_cast<float>(static_cast<std::uint32_t>(z) >> 8) * 0x1p-24f, static_cast<float>(z >> 40) * 0x1p-24f};
  }

 private:
  std::uint64_t state_;
};

RawTracer::RawTracer(const PhotonScene& scene) : scene_(scene) {
  const Scene& s = scene.scene();
  if (scene.emitters().empty()) throw InputError("the scene emits no light: there is nothing to measure");
  for (std::uint32_t i = 0; i < s.materials.size(); ++i) {
    const Bsdf bsdf = makeBsdf(s.materials[i], factorsOf(s.materials[i]));
    albedo_.push_back(std::min(maxComponent(albedo(bsdf, {0, 0, 1})), 0.95f));  // so that every path ends
  }
  for (const Triangle& t : s.triangles) materialOf_.push_back(static_cast<std::uint16_t>(t.material));
  addLamps(s);
}

void RawTracer::addLamps(const Scene& scene) {
  float sum = 0;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const Material& m = scene.materials[scene.triangles[i].material];
    const Vec3d n = scene.scaledNormal(i);
    if (!m.emits() || !(length(n) > 0)) continue;
    sum += static_cast<float>(length(n)) * mean(m.emissive);
    const Vec3f p0 = scene.corner(i, 0);
    lamps_.push_back({p0, scene.corner(i, 1) - p0, scene.corner(i, 2) - p0, Vec3f(normalize(n)), sum});
  }
  for (Lamp& l : lamps_) l.upTo /= sum;
}

RawTracer::Ray RawTracer::emit(Random& random) const {
  if (lamps_.empty()) return emitFromTable(random);
  const Vec2f pick = random.pair(), place = sampleTriangle(random.pair());
  const Lamp& l = *std::upper_bound(lamps_.begin(), lamps_.end() - 1, pick.x,
                                    [](float u, const Lamp& lamp) { return u < lamp.upTo; });
  return {l.p0 + l.e1 * place.x + l.e2 * place.y + l.n * kOffset,
          Frame<float>(l.n).toWorld(sampleCosineHemisphere(random.pair()))};
}

RawTracer::Ray RawTracer::emitFromTable(Random& random) const {
  const Vec2f pick = random.pair(), others = random.pair();
  const EmittedPhoton p = scene_.emitters().sample({static_cast<double>(pick.x), {pick.y, others.x, others.y}});
  return {Vec3f(p.position) + p.normal * kOffset, p.direction};
}

std::uint64_t RawTracer::tracePhoton(std::uint64_t index) const {
  Random random(index);
  Ray path = emit(random);
  for (std::uint64_t rays = 1;; ++rays) {
    RTCRayHit ray = rayHit(path.origin, path.direction);
    intersect(scene_.rayCaster().embreeScene(), ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return rays;
    if (random.pair().x >= albedo_[materialOf_[ray.hit.primID]]) return rays;
    const Vec3f front = normalize(Vec3f{ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
    const Vec3f n = dot(front, path.direction) > 0 ? -front : front;
    path.origin = path.origin + path.direction * ray.ray.tfar + n * kOffset;
    path.direction = Frame<float>(n).toWorld(sampleCosineHemisphere(random.pair()));
  }
}

std::uint64_t RawTracer::trace(std::uint64_t begin, std::uint64_t end) const {
  std::uint64_t rays = 0;
  for (std::uint64_t i = begin; i < end; ++i) rays += tracePhoton(i);
  return rays;
}

}  // namespace lucarne::bench
