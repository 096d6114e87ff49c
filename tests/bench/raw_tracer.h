// What a photon costs at least: rtcIntersect1 with the barest path around it. The yardstick of bench_rays.
//
// Emission from the lamp, a cheap random generator, the hit's normal from Embree's Ng, an offset, a cosine direction,
// Russian roulette against one albedo a material. No weights, textures, ledger, shading normals or exact hit points;
// front and back alike. The same Embree scene as the tracer's, so the same flags.
#pragma once

#include <cstdint>
#include <vector>

#include "tracer/transport/photon_scene.h"

namespace lucarne::bench {

class RawTracer {
 public:
  /// `scene` must outlive this.
  explicit RawTracer(const PhotonScene& scene);

  /// Traces photons [begin, end); returns how many rays they took.
  std::uint64_t trace(std::uint64_t begin, std::uint64_t end) const;

 private:
  struct Lamp {  // an emissive triangle
    Vec3f p0, e1, e2, n;
    float upTo;  // share of the light of this lamp and those before it
  };
  struct Ray {
    Vec3f origin, direction;
  };
  class Random;
  void addLamps(const Scene& scene);
  Ray emit(Random& random) const;
  Ray emitFromTable(Random& random) const;
  std::uint64_t tracePhoton(std::uint64_t index) const;

  const PhotonScene& scene_;
  std::vector<Lamp> lamps_;                // empty: the scene's lights are no triangles; the tracer's table is asked
  std::vector<float> albedo_;              // by material, largest channel
  std::vector<std::uint16_t> materialOf_;  // by triangle
};

}  // namespace lucarne::bench
