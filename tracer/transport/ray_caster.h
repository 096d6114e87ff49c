// Nearest hits over Embree. From Embree only the triangle is taken; t and barycentrics are recomputed in double from
// our own vertices, so that the numbers do not depend on how Embree's kernels round.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/huge_allocator.h"
#include "base/vec_pair.h"
#include "tracer/scene/scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCFilterFunctionNArguments;

namespace lucarne {

class SurfaceTable;

struct Hit {
  std::uint32_t triangle;
  Vec2f b;         // barycentrics (b1, b2), clamped into the triangle
  Vec3d position;  // local, on the triangle's plane
  Vec3f n;         // unit geometric normal of the front
  bool back;       // the ray came from behind
  bool smooth;     // of the triangle: normals are interpolated
  std::uint32_t material;
  float clearance;  // local; rays that leave start so far off the triangle
};

/// Asked at triangles with holes that a ray may meet. The answer depends on the ray and the hit alone: the question
/// comes in any order, of triangles behind the one that is met, too, and of some twice.
class HoleQuestion {
 public:
  virtual bool goesThrough(const Hit& hit) const = 0;

 protected:
  ~HoleQuestion() = default;
};

struct RayCasterOptions {
  std::string isa;     // "avx2", "sse4.2", …; empty: avx2 where the processor has it
  bool robust = true;  // watertight edges, 13–20 % slower
};

class RayCaster {
 public:
  /// `surfaces` says which materials have holes; null: none.
  explicit RayCaster(const Scene& scene, const RayCasterOptions& options = {}, const SurfaceTable* surfaces = nullptr);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Nearest triangle along a unit direction, ignoring `from` (the triangle that the ray leaves, or kNone) and what
  /// light goes through (`holes`; null: nothing); kNone where there is none. `repeats` counts the rare rays that met
  /// `from` again by rounding and were cast on.
  std::uint32_t nearest(Vec3f origin, Vec3f direction, std::uint32_t from, std::uint64_t& repeats,
                        const HoleQuestion* holes = nullptr) const;

  /// What a ray meets for which nearest() found the back of a one-sided triangle, or a triangle that it starts on and
  /// shall not meet. Triangles that touch are told apart: a ray that starts on the triangle goes on (a lamp that
  /// touches a wall is in front of it), and where the front of another lies on a back (rooms wall to wall, both faces
  /// of a wall without thickness) it meets that front. `met` itself where neither is so; kNone where the ray goes on
  /// and there is nothing.
  std::uint32_t past(std::uint32_t met, Vec3f origin, Vec3f direction, std::uint32_t from, std::uint64_t& repeats,
                     const HoleQuestion* holes = nullptr) const;
  /// True where a ray from `origin`, which left the triangle `from` (or kNone), starts on the very triangle that it
  /// meets.
  bool startsOn(const Hit& hit, Vec3f origin, std::uint32_t from) const {
    const float left = from == kNone ? 0.f : triangles_[from].clearance;
    return std::abs(dot(Vec3d(hit.n), hit.position - Vec3d(origin))) <=
           2 * static_cast<double>(std::max(left, hit.clearance));
  }

  /// Asks for what intersect() will read.
  void prefetch(std::uint32_t triangle) const { __builtin_prefetch(&triangles_[triangle]); }
  /// Where a ray that is known to meet the triangle does so.
  Hit intersect(std::uint32_t triangle, Vec3f origin, Vec3f direction) const;

  /// A point just off the triangle at `position` on it, on the side of `n`: far enough that neither it nor a neighbour
  /// in its plane is met again, and no farther (see clearance.h).
  static Vec3f leave(Vec3d position, Vec3f n, float clearance) {
    return Vec3f(position + Vec3d(n) * static_cast<double>(clearance));
  }
  float clearance(std::uint32_t triangle) const { return triangles_[triangle].clearance; }

  /// What was built with, for reports: "Embree 3.13.5, avx2, robust".
  const std::string& description() const { return description_; }
  const std::string& isa() const { return isa_; }
  RTCSceneTy* embreeScene() const { return embreeScene_; }

 private:
  struct alignas(64) TriangleData {  // one cache line a triangle
    Vec3f p0, e1, e2, n;
    std::uint32_t material : 30, smooth : 1, holes : 1;
    float inset;  // smallest barycentric coordinate of a hit
    float clearance;
  };
  static_assert(sizeof(Vec3f) == 12);
  struct Question;
  struct FrontSearch;
  void build(const Scene& scene, const RayCasterOptions& options, const SurfaceTable* surfaces);
  std::uint32_t cast(Vec3f origin, Vec3f direction, float tnear, std::uint32_t from, std::uint64_t& repeats,
                     const HoleQuestion* holes) const;
  std::uint32_t castAgain(Vec3f origin, Vec3f direction, std::uint32_t from, std::uint64_t& repeats,
                          const HoleQuestion* holes) const;
  std::uint32_t castThroughHoles(Question& question, float tnear) const;
  bool isClosed() const;
  bool isWithinBounds(Vec3f p) const;
  static void filter(const RTCFilterFunctionNArguments* arguments);
  std::uint32_t frontOn(const Hit& back, Vec3f origin, Vec3f direction, const HoleQuestion* holes) const;

  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* embreeScene_ = nullptr;
  std::vector<TriangleData, HugeAllocator<TriangleData>> triangles_;
  bool anyHoles_ = false, closed_ = false;
  Vec3f lower_{}, upper_{};  // bounds
  std::string description_, isa_;
};

/// Möller and Trumbore 1997 in double, known to hit: results are clamped into the triangle instead of tested, a ray in
/// its plane (0/0, 1/0) too: std::max(inset, NaN) is inset. Side by the sign of direction · n. Hits stay off the edges
/// by the inset, or a ray that leaves in a corner could start, by rounding, on the other side of the neighbour.
inline Hit RayCaster::intersect(std::uint32_t triangle, Vec3f origin, Vec3f direction) const {
  const TriangleData& t = triangles_[triangle];
  const Vec3dPair p0(t.p0), e1(t.e1), e2(t.e2), d(direction), s = Vec3dPair(origin) - p0;
  const Vec3dPair p = cross(d, e2);
  const double inv = 1 / dot(e1, p), inset(t.inset);
  const double b1 = std::min(std::max(inset, dot(s, p) * inv), 1.0 - 2 * inset);
  const double b2 = std::min(std::max(inset, dot(d, cross(s, e1)) * inv), 1.0 - inset - b1);
  return {triangle,
          {static_cast<float>(b1), static_cast<float>(b2)},
          Vec3d(p0 + e1 * b1 + e2 * b2),
          t.n,
          dot(t.n, direction) > 0,
          t.smooth != 0,
          t.material,
          t.clearance};
}

}  // namespace lucarne
