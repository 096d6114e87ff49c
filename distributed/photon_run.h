// Traces ranges of photons into tallies with all threads of this process.
#pragma once

#include <functional>
#include <memory>

#include "dlm/deposit.h"
#include "dlm/tally.h"
#include "tracer/optics/sampler.h"
#include "tracer/transport/ledger.h"
#include "tracer/transport/photon_scene.h"

namespace lucarne {

struct PhotonRunOptions {
  PhotonSeed seed = 0;
  int threads = 1;
  LightPart part = LightPart::all;
  TraceLimits limits;
  std::uint64_t privateTallyBytes = std::uint64_t{1} << 30;  // threads get tallies of their own while all fit in this
  std::function<bool()> stop = {};  // asked by all threads, every few thousand photons; true: abandon the batch
};

/// True where every thread but the first gets tallies of its own, false where they share one set.
bool hasPrivateTallies(const TallyLayout& layout, const PhotonRunOptions& options);

struct RunProgress {
  std::uint64_t photons, rays;
};

/// What photons are traced through and counted in. All must outlive the run.
struct PhotonTask {
  const PhotonScene& scene;
  const TexelMap& map;
  const TallyLayout& layout;
  const DirectionSet& directions;
};

/// Threads take chunks of a range from a counter; adds are integers, so the result is the same for every number of
/// threads and every cut into ranges.
class PhotonRun {
 public:
  PhotonRun(const PhotonTask& task, const PhotonRunOptions& options, Tallies& tallies);
  ~PhotonRun();
  PhotonRun(const PhotonRun&) = delete;
  PhotonRun& operator=(const PhotonRun&) = delete;

  /// Traces the range in batches of about a quarter of a second; `progress` is called between them, with what all
  /// ranges since the last collect() came to, and when it returns false the run stops after a whole batch. Where the
  /// options' `stop` says so it ends in the middle of one: every photon that was begun is finished, and they are a
  /// beginning of the range all the same. Returns how many photons of the range, from its beginning, were traced.
  std::uint64_t trace(IndexRange range, const std::function<bool(const RunProgress&)>& progress);

  /// Brings everything traced since the last call into the tallies, and adds its ledger. Throws Error(outOfResource)
  /// when the ledger's incident flux passes the 63 bits that a single tally holds.
  void collect(Ledger& ledger);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// One range from beginning to end: trace and collect.
std::uint64_t runPhotons(const PhotonTask& task, IndexRange range, const PhotonRunOptions& options, Tallies& tallies,
                         Ledger& ledger, const std::function<bool(const RunProgress&)>& progress);

/// True from where tallies are more than half full by the sum of all deposits.
bool nearlyFull(const FluxSum& incident);

/// No tally can overflow while the sum of all deposits fits 63 bits, since every deposit is ≥ 0: throws
/// Error(outOfResource) when it does not.
void checkTalliesFit(const FluxSum& incident);

}  // namespace lucarne
