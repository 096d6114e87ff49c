// How fast photons are traced and counted in one scene, against bare rays. Rates are rays per second of a thread's CPU
// time, so that neither the number of rays a photon takes nor other work on the machine decides. All kinds of tracing
// take short turns; ratios are formed within a round and their median is the result.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/bake_plan.h"
#include "tests/bench/bench_memory.h"
#include "tracer/scene/scene.h"

namespace lucarne {
class PhotonScene;
}

namespace lucarne::bench {

/// A median with its quartiles.
struct Spread {
  double median = 0, low = 0, high = 0;
};

struct SceneResult {
  std::string name, rayCaster;  // rayCaster: RayCaster::description()
  std::uint64_t triangles = 0, texels = 0;
  std::uint64_t sceneBytes = 0, embreeBytes = 0, tallyBytes = 0;  // of the arrays of Scene; one copy of the tallies
  MemoryUse memory;
  bool sharedTallies = false;  // as PhotonRun decides for two threads
  int rounds = 0;
  double rawRaysPerPhoton = 0, raysPerPhoton = 0;
  Spread rawRaysPerSecond, traceRaysPerSecond, depositRaysPerSecond;
  Spread traceOverRaw;       // path logic whole, hits thrown away
  Spread depositOverRaw;     // hits counted in tallies of this thread's own
  Spread twoThreadsOverOne;  // both with deposits; 2 is the best there is
};

/// The light maps that all is measured with.
BakePlan makeBenchPlan(const Scene& scene);

/// Of the arrays of Scene.
std::uint64_t sceneBytes(const Scene& scene);

/// Bytes that Embree holds for the scene, which is gone afterwards.
std::uint64_t embreeBytes(std::unique_ptr<PhotonScene> scene);

/// Takes about `seconds` of wall time on two idle cores, and what charts and trees take to build.
SceneResult measure(const std::string& name, const Scene& scene, double seconds);

}  // namespace lucarne::bench
