// What a bake will take of memory and disk, known before it starts. The one prediction of `bake` and `check`.
#pragma once

#include <cstdint>
#include <string>

#include "app/bake_plan.h"

namespace lucarne {

/// What a process holds before tallies are made: the scene and all that is built on it; and the most that it held on
/// the way there.
struct MemorySoFar {
  std::uint64_t resident = 0, peak = 0;
  static MemorySoFar now();
};

/// Bytes of one process.
struct MemoryNeeds {
  std::uint64_t base = 0;     // resident before tallies are made
  std::uint64_t earlier = 0;  // peak before that
  std::uint64_t tallies = 0;  // of all sets
  std::uint64_t tracing = 0;  // beside them: tallies of threads' own, what lookups and estimates of the error need
  std::uint64_t maps = 0;     // beside them, after tracing: making and writing light maps
  std::uint64_t peak() const { return std::max(earlier, base + tallies + std::max(tracing, maps)); }
};

/// Of rank 0 where there are several: the others make no maps.
MemoryNeeds predictMemory(const BakeOptions& options, const Scene& scene, const BakePlan& plan, const MemorySoFar& soFar);

struct DiskNeeds {
  std::uint64_t maps = 0;   // the folder of light maps, before compression
  std::uint64_t state = 0;  // one saved state, or a part
};
DiskNeeds predictDisk(const BakeOptions& options, const Scene& scene, const BakePlan& plan, std::uint64_t glbBytes);

/// How many bytes a process may take for it to fit: as --memory says, or what is free, shared by `processes`.
std::uint64_t allowedMemory(const BakeOptions& options, int processes);

/// Error(outOfResource), telling which density or how many directions would fit, when the peak is more than `allowed`.
/// Where only threads' own tallies make it so, turns them off in `options` instead. Returns the prediction.
MemoryNeeds requireMemory(BakeOptions& options, const Scene& scene, const BakePlan& plan, const MemorySoFar& soFar,
                          std::uint64_t allowed);

/// Error(outOfResource) unless the output and two states have room, given that the states there are take
/// `statesThere`.
void requireDisk(const BakeOptions& options, const DiskNeeds& needs, std::uint64_t statesThere);

}  // namespace lucarne
