// Nearest hits over Embree. From Embree only the triangle is taken; t and barycentrics are recomputed in double from our own
// vertices, so that the numbers do not depend on how Embree's kernels round.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "tracer/scene/scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace lucarne {

struct Hit {
  std::uint32_t triangle;
  Vec2f b;        // barycentrics (b1, b2), clamped into the triangle
  Vec3d position; // local, on the triangle's plane
  Vec3f n;        // unit geometric normal of the front
  bool back;      // the ray came from behind
  bool smooth;    // of the triangle: normals are interpolated
  std::uint32_t material;
};

struct RayCasterOptions {
  std::string isa;      // "avx2", "sse4.2", …; empty: avx2 where the processor has it
  bool robust = true;   // watertight edges, 13–20 % slower
};

class RayCaster {
 public:
  explicit RayCaster(const Scene& scene, const RayCasterOptions& options = {});
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  /// Nearest triangle along a unit direction, ignoring `from` (the triangle that the ray leaves, or kNone). `repeats` counts
  /// the rare rays that met `from` again by rounding and were cast on.
  std::optional<Hit> nearest(Vec3f origin, Vec3f direction, std::uint32_t from, std::uint64_t& repeats) const;

  /// A point just off the surface at `position`, on the side of `n`: far enough that the surface is not met again.
  static Vec3f leave(Vec3d position, Vec3f n);

  /// What was built with, for reports: "Embree 3.13.5, avx2, robust".
  const std::string& description() const { return description_; }
  const std::string& isa() const { return isa_; }
  RTCSceneTy* embreeScene() const { return embreeScene_; }

 private:
  struct alignas(64) TriangleData {  // one cache line a triangle
    Vec3f p0, e1, e2, n;
    std::uint32_t material;
    bool smooth;
  };
  std::optional<Hit> intersect(std::uint32_t triangle, Vec3f origin, Vec3f direction) const;
  void build(const Scene& scene, const RayCasterOptions& options);

  RTCDeviceTy* device_ = nullptr;
  RTCSceneTy* embreeScene_ = nullptr;
  std::vector<TriangleData> triangles_;
  std::string description_, isa_;
};

}  // namespace lucarne
