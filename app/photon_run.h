// Traces a range of photons into tallies with all threads.
#pragma once

#include <functional>

#include "dlm/deposit.h"
#include "dlm/tally.h"

namespace lucarne {

struct PhotonRunOptions {
  std::uint64_t seed = 0;
  int threads = 1;
  LightPart part = LightPart::all;
  TraceLimits limits;
  std::uint64_t privateTallyBytes = std::uint64_t{1} << 30;  // threads get tallies of their own while all fit in this
};

struct RunProgress {
  std::uint64_t photons, rays;
};

/// Threads take chunks of the range from a counter; adds are integers, so the result is the same for every number of
/// threads. `progress` is called from the calling thread between batches; when it returns false the run stops after a whole
/// batch. Returns how many photons of the range, from its beginning, were traced.
std::uint64_t runPhotons(const PhotonScene& scene, const TexelMap& map, const TallyLayout& layout, const DirectionSet& directions,
                         IndexRange range, const PhotonRunOptions& options, Tallies& tallies, Ledger& ledger,
                         const std::function<bool(const RunProgress&)>& progress);

}  // namespace lucarne
