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
  std::uint64_t sceneBytes = 0, embreeBytes = 0;      // sceneBytes: of the arrays of Scene
  std::uint64_t tallyBytes = 0, largeTallyBytes = 0;  // one copy of each kind of tallies
  MemoryUse memory;
  bool sharedTallies = false;  // as PhotonRun decides for two threads
  int rounds = 0;
  double rawRaysPerPhoton = 0, raysPerPhoton = 0;
  Spread rawRaysPerSecond, traceRaysPerSecond, depositRaysPerSecond;
  Spread traceOverRaw;       // path logic whole, hits thrown away
  Spread depositOverRaw;     // hits counted as by a bake with default settings, in tallies of this thread's own
  Spread largeOverRaw;       // the same in the large plan
  Spread twoThreadsOverOne;  // both with deposits, default settings; 2 is the best there is
};

/// Light maps as a bake with default settings makes them: one irradiance map where all is diffuse.
BakePlan makeDefaultPlan(const Scene& scene);

/// 400,000 texels with all 14 directions on every side, as if all were glossy: 120 MB and more.
BakePlan makeLargePlan(const Scene& scene);

/// Of the arrays of Scene.
std::uint64_t sceneBytes(const Scene& scene);

/// Bytes that Embree holds for the scene, which is gone afterwards.
std::uint64_t embreeBytes(std::unique_ptr<PhotonScene> scene);

/// Takes about `seconds` of wall time on two idle cores, and what charts and trees take to build.
SceneResult measure(const std::string& name, const Scene& scene, double seconds);

}  // namespace lucarne::bench
