// Glasses and directions that the tests of glass share.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/tracer/mean.h"
#include "tracer/optics/dielectric.h"
#include "tracer/optics/glass.h"
#include "tracer/optics/sampler.h"

namespace lucarne::test {

struct GlassCase {
  float ior;
  bool inside, thin;
  float alpha;

  float eta() const { return inside ? 1 / ior : ior; }
  Glass glass() const {
    Glass g;
    g.tint = {0.9f, 0.6f, 0.3f};
    g.reflectance = {0.8f, 0.9f, 1.f};
    g.eta = eta();
    g.alpha = alpha;
    g.thin = thin;
    return g;
  }
  Glass white() const {
    Glass g = glass();
    g.tint = g.reflectance = Rgb{1.f};
    return g;
  }
  std::string name() const {
    return "ior " + std::to_string(ior) +
           (inside ? " inside"
            : thin ? " thin"
                   : " outside") +
           " alpha " + std::to_string(alpha);
  }
};

inline std::vector<GlassCase> glassCases(const std::vector<float>& alphas) {
  std::vector<GlassCase> cases;
  for (const float alpha : alphas) {
    for (const float ior : {1.1f, 1.5f, 2.4f}) {
      cases.push_back({ior, false, false, alpha});
      cases.push_back({ior, true, false, alpha});
    }
    cases.push_back({1.5f, false, true, alpha});
  }
  return cases;
}

inline Vec3f atCosine(float c) { return {std::sqrt(1 - c * c) * 0.6f, std::sqrt(1 - c * c) * -0.8f, c}; }
inline std::vector<Vec3f> glassDirections() { return {{0, 0, 1}, atCosine(0.75f), atCosine(0.4f), atCosine(0.05f)}; }

/// The boundary and a direction from its other side (see glass.h).
inline Glass other(Glass g) {
  if (!g.thin) g.eta = 1 / g.eta;
  return g;
}
inline Vec3f flipped(Vec3f w) { return {w.x, w.y, -w.z}; }

inline Vec3f glassRandoms(std::uint64_t seed, std::uint64_t i) {
  const auto u = PhotonSampler(seed, i).floats(1, Stream::scatter);
  return {u[0], u[1], u[2]};
}

}  // namespace lucarne::test
