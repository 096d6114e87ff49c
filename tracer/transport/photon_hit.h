// What a sink of photons is told of a hit.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "tracer/transport/ray_caster.h"

namespace lucarne {

struct IndexRange {
  std::uint64_t begin = 0, end = 0;
  std::uint64_t size() const { return end - begin; }
};

struct PhotonHit {
  const Hit& hit;
  std::uint32_t event;  // 1 is the first hit: direct light
  bool odd;             // of the photon's index: the two halves of the photons are scrambled apart
  // The numbers of this event. Scattering uses the top 24 bits of each; the low 8 are free for rounding.
  const std::array<std::uint32_t, 4>& words;
  Rgb beta;     // incident flux as a fraction of the emitted flux
  Vec3f wi;     // unit, away from the surface toward where the light came from
  Vec3f n, ns;  // geometric and interpolated normal of the side hit (normal maps are left to whoever shades)
};

struct TraceLimits {
  // A closed white room still ends. At albedo 0.9 the light past bound d is 0.9^d: 1e-47.
  std::uint32_t depth = 1024;
};

}  // namespace lucarne
