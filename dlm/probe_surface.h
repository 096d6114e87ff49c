// The chart side that a point and a normal mean.
#pragma once

#include <optional>

#include "dlm/light_maps.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

struct SurfacePoint {
  std::uint32_t triangle = kNone, chart = kNone;
  bool back = false;
  Vec3d normal{};  // unit, of the side: what its light was received with
  Vec2d st{};      // texel coordinates in the chart's rectangle
};

class SurfaceFinder {
 public:
  /// Both must outlive the finder. `scene` as read from a .dlm: charts of the triangles, atlasUv.
  SurfaceFinder(const Scene& scene, const LightMaps& maps);

  /// The nearest point of a triangle no farther than one texel of its chart, on a side whose normal has a dot product
  /// above ½ with `n` (unit). `position` in metres. Triangles without chart are passed over. A side that absorbs unseen
  /// (the back of a one-sided material) counts as a tenth of a texel farther: of two walls back to back, the one that
  /// faces `n` is meant.
  std::optional<SurfacePoint> find(Vec3d position, Vec3d n) const;

 private:
  struct Candidate {
    double score;  // local distance and penalty
    std::uint32_t triangle;
    bool back;
    double b1, b2;  // barycentrics
  };
  class Query;
  std::optional<Candidate> judge(std::uint32_t triangle, Vec3d local, Vec3d n) const;
  SurfacePoint describe(const Candidate& candidate) const;
  Vec3d shadingNormal(std::uint32_t triangle, double b1, double b2) const;

  const Scene& scene_;
  const LightMaps& maps_;
  RayCaster caster_;     // for its tree of the triangles
  double largestTexel_;  // local units
};

}  // namespace lucarne
