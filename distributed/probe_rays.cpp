#include "distributed/probe_rays.h"

#include <bit>

#include "base/float_mode.h"
#include "tracer/transport/any_sink.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kSegments = 4096, kSeed = 0x4c75636172'6e65;
constexpr std::uint32_t kDepth = 8;

struct HashingSink {
  Hasher hasher;
  void hit(const PhotonHit& h) {
    hasher.addNumber(h.hit.triangle);
    for (const float f : {h.hit.b.x, h.hit.b.y, h.beta.x, h.beta.y, h.beta.z, h.wi.x, h.wi.y, h.wi.z})
      hasher.addNumber(std::bit_cast<std::uint32_t>(f));
  }
  void endPhoton() {}
};

}  // namespace

Hash128 probeRays(const PhotonScene& scene) {
  const FlushDenormals mode;
  HashingSink sink;
  Ledger ledger;
  TraceLimits limits;
  limits.depth = kDepth;
  for (std::uint64_t i = 0; i < kSegments && ledger.rays < kSegments; ++i)
    flyPhotons(scene, {i, i + 1}, kSeed, limits, sink, ledger);
  return sink.hasher.finish();
}

}  // namespace lucarne
