// Photons flown for tests, and sinks that measure them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/support/scene_builder.h"
#include "tests/support/statistics.h"
#include "tests/tracer/mean.h"
#include "tracer/transport/any_sink.h"

namespace lucarne::test {

struct NoSink {
  void hit(const PhotonHit&) {}
  void endPhoton() {}
};

/// Flux that arrives at places, per photon and in units of the emitted flux. `place(hit)` is an index, or beyond the
/// last one for hits that do not count. Standard errors are those of independent photons.
template <class Place>
class FluxMeter {
 public:
  FluxMeter(std::size_t places, Place place) : place_(std::move(place)), photon_(places), flux_(places) {}
  void hit(const PhotonHit& h) {
    const auto i = static_cast<std::size_t>(place_(h));
    if (i < photon_.size()) photon_[i] += static_cast<double>(mean(h.beta));
  }
  void endPhoton() {
    for (std::size_t i = 0; i < photon_.size(); ++i) flux_[i].add(std::exchange(photon_[i], 0));
  }
  const Mean& operator[](std::size_t i) const { return flux_[i]; }

 private:
  Place place_;
  std::vector<double> photon_;
  std::vector<Mean> flux_;
};

template <class Sink>
Ledger fly(const PhotonScene& scene, std::uint64_t photons, Sink& sink, const PhotonSeed& seed = 1,
           const TraceLimits& limits = {}) {
  Ledger ledger;
  flyPhotons(scene, {0, photons}, seed, limits, sink, ledger);
  return ledger;
}

inline Ledger fly(const PhotonScene& scene, std::uint64_t photons, const PhotonSeed& seed = 1,
                  const TraceLimits& limits = {}) {
  NoSink sink;
  return fly(scene, photons, sink, seed, limits);
}

/// Flux of one channel as a share of the emitted one.
inline double share(const FluxSum& sum, const Ledger& ledger, std::size_t channel = 0) {
  return static_cast<double>(sum.units[channel]) / static_cast<double>(ledger.emitted.units[channel]);
}

inline void expectBalance(const Ledger& ledger) {
  EXPECT_TRUE(ledger.balance() == ledger.emitted);
  EXPECT_EQ(ledger.strayValues, 0u);
}
inline void expectNothingEscapes(const Ledger& ledger) { EXPECT_TRUE(ledger.escaped == FluxSum{}) << ledger.rays; }

/// Within the standard error of `measured`, for one of `questions` questions; `slack` is for what the closed form
/// leaves out.
inline void expectMean(const Mean& measured, double expected, std::uint64_t questions, double slack = 0) {
  EXPECT_NEAR(measured.mean(), expected, zThreshold(questions) * measured.error() + slack)
      << (measured.mean() - expected) / measured.error() << " standard errors";
}

inline Light sunLight(Vec3d direction, Rgb lux) {
  Light l;
  l.name = "sun";
  l.kind = LightKind::directional;
  l.intensity = lux;
  l.direction = normalize(direction);
  return l;
}
inline Light bulbLight(Vec3d position, Rgb candela) {
  Light l;
  l.name = "bulb";
  l.intensity = candela;
  l.position = position;
  return l;
}

/// A horizontal square about (x, z) = (0, 0), front up.
inline void addPlate(SceneBuilder& b, double y, double half, std::uint32_t material) {
  b.addQuad({-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}, material);
}

}  // namespace lucarne::test
