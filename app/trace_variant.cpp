#include "app/trace_variant.h"

#include <ctime>

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "base/float_mode.h"
#include "tracer/transport/any_sink.h"

namespace lucarne {
namespace {

struct NoSink {
  void hit(const PhotonHit&) {}
  void endPhoton() {}
};

double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// CPU seconds of photons that no bake of a small seed has; their rays are added to `rays`.
double secondsOf(const PhotonScene& scene, std::size_t variant, IndexRange photons, std::uint64_t& rays) {
  constexpr std::uint64_t kSeed = 0x76617269616e74;
  NoSink sink;
  Ledger ledger;
  const double start = threadSeconds();
  flyPhotons(scene, photons, kSeed, {}, sink, ledger, variant);
  rays += ledger.rays;
  return threadSeconds() - start;
}

}  // namespace

nlohmann::json traceVariant(const Scene& scene) {
  const PhotonVariant& variant = kPhotonVariants[photonVariantFor(featuresOf(scene))];
  nlohmann::json without = nlohmann::json::array();
  const auto list = [&](bool has, const char* name) {
    if (!has) without.push_back(name);
  };
  list(variant.features.coats, "coats");
  list(variant.features.textures, "textures");
  list(variant.features.normalMaps, "normal maps");
  list(variant.features.holes, "alpha");
  list(variant.features.transmission, "transmission");
  return {{"name", variant.name}, {"without", without}};
}

double traceVariantSpeedup(const PhotonScene& scene) {
  const std::size_t variant = photonVariantFor(scene.surfaces().features());
  if (variant == kGeneralVariant || scene.emitters().empty()) return 1;
  const FlushDenormals mode;
  constexpr int kRounds = 9;
  constexpr std::uint64_t kStep = 200;
  std::vector<double> ratios;
  std::uint64_t rays = 0, generalRays = 0;
  for (std::uint64_t round = 0; round < kRounds; ++round) {
    // Whoever comes second finds the scene in the caches: each does once.
    const IndexRange a{2 * round * kStep, (2 * round + 1) * kStep}, b{a.end, a.end + kStep};
    double own = secondsOf(scene, variant, a, rays);
    double general = secondsOf(scene, kGeneralVariant, a, generalRays);
    general += secondsOf(scene, kGeneralVariant, b, generalRays);
    own += secondsOf(scene, variant, b, rays);
    if (own > 0) ratios.push_back(general / own);
  }
  LUCARNE_CHECK_EQ(rays, generalRays);
  if (ratios.empty()) return 1;
  std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
  return ratios[ratios.size() / 2];
}

}  // namespace lucarne
