// What a bake of a scene takes of memory, against what it cannot do without: Embree's tree and one copy of the tallies.
#pragma once

#include <cstdint>

#include "tracer/scene/scene.h"

namespace lucarne::bench {

struct MemoryUse {
  std::uint64_t peak = 0;  // bytes resident at most, while all was set up and while photons were traced on one thread
  std::uint64_t held = 0;  // bytes resident while photons were traced
  std::uint64_t embree = 0, tallies = 0;
  double peakOver() const { return static_cast<double>(peak) / static_cast<double>(embree + tallies); }
  double heldOver() const { return static_cast<double>(held) / static_cast<double>(embree + tallies); }
};

/// With the large plan of bench_measure.h. In a process of its own, that freed memory of other measurements does not
/// count: call it before this process starts threads. The scene's arrays are in it, its images are not.
MemoryUse measureMemory(const Scene& scene);

}  // namespace lucarne::bench
