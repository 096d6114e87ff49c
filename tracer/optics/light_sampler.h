// Directions toward the light of a point: next-event estimation. Emitters are those of EmitterTable, the other way
// round: not where photons start, but where a point looks for its light.
#pragma once

#include <optional>
#include <vector>

#include "tracer/optics/emitters.h"

namespace lucarne {

struct LightSample {
  Vec3f wi;                // unit, toward the light
  double distance;         // local; infinity: none
  Vec3d target;            // local point on the light; meaningless at infinity
  Vec3f normal;            // of the emitting side there; zero for lights without surface
  std::uint32_t triangle;  // kNone: none
  // Radiance over density of a light with extent, or what a punctual light gives on a perpendicular plane over the
  // probability of its choice: times f·|cos| it estimates what the point scatters. cd/m² or lx. No shadow.
  Rgb weight;
  double pdf;  // per steradian, of all ways to get it in sampleLocal() or sampleSky(); 0: no other ray finds this light
};

/// Three numbers in [0, 1).
struct LightNumbers {
  double pick;
  Vec2f place;
};

class LightSampler {
 public:
  /// All must outlive this.
  LightSampler(const Scene& scene, const EmitterTable& emitters, const SurfaceTable& surfaces);

  /// One of the lamps, by flux. Empty where there is none or where it turns its back on `from` (local).
  std::optional<LightSample> sampleLocal(Vec3d from, const LightNumbers& u) const;
  /// Density per steradian with which sampleLocal() finds a place on an emissive triangle; 0 elsewhere.
  double pdfLocal(Vec3d from, std::uint32_t triangle, Vec2f b) const;

  std::optional<LightSample> sampleSky(Vec2f u) const;
  double pdfSky(Vec3f wi) const;
  Rgb skyRadiance(Vec3f wi) const;

 private:
  std::optional<LightSample> onTriangle(Vec3d from, std::size_t emitter, Vec2f u) const;
  std::optional<LightSample> atLight(Vec3d from, std::size_t emitter) const;
  double probability(std::size_t emitter) const { return emitters_.emitter(emitter).flux / localFlux_; }
  double pdfOnFace(Vec3d from, Vec3d at, const EmitterTable::Face& face, std::size_t emitter) const;

  const Scene& scene_;
  const EmitterTable& emitters_;
  const SurfaceTable& surfaces_;
  double localFlux_ = 0;
  std::vector<std::uint32_t> faceOfTriangle_;  // kNone: emits nothing
};

}  // namespace lucarne
