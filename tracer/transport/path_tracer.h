// A path tracer over the same scene, emitters and BSDFs as the photon tracer: the ground truth.
//
// It looks for light where photons carry it: paths start at the eye or at a place on a surface, and find light by
// next-event estimation (lamps and sky by their own densities) and by the BSDF, joined by multiple importance sampling
// with the balance heuristic (Veach and Guibas 1995). Nothing is shared with the photon tracer but the description of
// the scene, so the two agree in expectation only if both are right. Clamps that the photon tracer applies to shading
// normals are applied here, too. Beyond PathLimits::depth scatterings light is dropped.
#pragma once

#include <array>

#include "tracer/optics/light_sampler.h"
#include "tracer/optics/scattering.h"
#include "tracer/transport/meet.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

struct PathLimits {
  std::uint32_t depth = 1023;  // scatterings; a photon that scatters so often makes one hit more
};

/// Where light falls: a place on one side of a triangle.
struct Receiver {
  Hit hit;      // `back` says which side
  Vec3f n, ns;  // geometric and interpolated normal of that side
};
Receiver receiverAt(const PhotonScene& scene, std::uint32_t triangle, Vec2f b, bool back);

/// One estimate of the light that falls on a place, in pieces by direction.
struct ReceivedLight {
  struct Piece {
    Vec3f wi;     // unit, toward the light
    Rgb lux;      // as photon hits are stored: by the interpolated normal, clamped
    bool direct;  // came from the source without scattering
  };
  std::array<Piece, 4> pieces;
  std::size_t count = 0;

  void add(Vec3f wi, Rgb lux, bool direct) {
    if (maxComponent(lux) > 0) pieces[count++] = {wi, lux, direct};
  }
};

class PathTracer {
 public:
  /// `scene` must outlive this.
  explicit PathTracer(const PhotonScene& scene, const PathLimits& limits = {});

  /// One sample of the radiance that arrives against ray.direction, cd/m². A sampler's numbers are used once.
  Rgb radiance(const RayStart& ray, const PhotonSampler& sampler) const;
  /// One sample of the light that falls on a place: Σ lux is an unbiased estimate of the irradiance.
  ReceivedLight receive(const Receiver& at, const PhotonSampler& sampler) const;
  /// The direct pieces of receive(), of the same numbers: nothing is followed beyond the first surface.
  ReceivedLight receiveDirect(const Receiver& at, const PhotonSampler& sampler) const;

 private:
  /// A ray on its way, what its light counts, and how likely its direction was (per steradian; 0: given).
  struct Walk {
    RayStart ray;
    Vec3d from{};  // the place that it left, which densities of lights are seen from
    Rgb throughput{1.f};
    double pdf = 0;
    std::uint32_t medium = kNone;
  };
  struct Vertex;
  struct Found {
    Rgb direct{}, indirect{};
  };
  enum class Source { lamps, sky };

  Found follow(Walk walk, const PhotonSampler& sampler) const;
  /// To the next surface, none when it is the sky's; adds what shines from either to `seen`.
  std::optional<Hit> advance(Walk& walk, std::uint32_t event, const PhotonSampler& sampler, Rgb& seen) const;
  void receiveLights(const Receiver& at, const PhotonSampler& sampler, ReceivedLight& received) const;
  Walk walkFrom(const Receiver& at, const PhotonSampler& sampler) const;
  bool walkOn(Walk& walk, const Vertex& vertex, std::uint32_t event, const PhotonSampler& sampler) const;
  std::optional<LightSample> sampleLight(Source source, Vec3d from, std::uint32_t event,
                                         const PhotonSampler& sampler) const;
  Rgb lightAt(const Vertex& vertex, Source source, std::uint32_t event, const PhotonSampler& sampler) const;
  Rgb emitted(const Hit& hit, const Walk& walk) const;
  Rgb sky(const Walk& walk) const;
  /// Share of a light sample that reaches the start: shadows, holes, and the volume between.
  Rgb visibility(const RayStart& ray, const LightSample& light, std::uint32_t medium) const;
  Rgb transmittance(std::uint32_t medium, double localDistance) const;

  const PhotonScene& scene_;
  LightSampler lights_;
  PathLimits limits_;
  bool raysFindLight_;  // there is light with an extent
};

}  // namespace lucarne
