// A bake as work: which samples of direct light are still to be gathered and which photons to be traced, and a state
// that is saved on the way.
#pragma once

#include <functional>

#include "distributed/checkpoint.h"
#include "distributed/direct_run.h"
#include "distributed/photon_run.h"

namespace lucarne {

/// Direct light to be gathered, before photons are traced.
struct DirectJob {
  const DirectGather& gather;
  IndexRange range;  // of samples in all, those of earlier runs included
};

struct BakeJob {
  PhotonTask task;
  PhotonRunOptions run;
  IndexRange range;                     // of photons in all, those of earlier runs included
  std::span<const std::uint8_t> scene;  // packed, as states carry it
  double checkpointSeconds = 300;       // 0: no states
  bool lastStateIsWanted = false;  // for itself; else it only guards what follows, and failing to save it is no error
  std::function<void(const RunProgress&)> progress;  // photons and rays so far, earlier runs included
  std::optional<DirectJob> direct = {};
};

/// What there is of a bake: its header says of which photons.
struct BakeState {
  PartHeader header;
  Tallies tallies;
  // Of this run: how many states were saved on the way and at the end, and what that took.
  std::uint64_t checkpoints = 0;
  double checkpointSeconds = 0;
  double variantSpeedup = 0;  // of the tracing loop over one that does everything; 0: not measured
};

/// The photons of `range` that `state` lacks. Throws Error(mergeRefused) naming `file` unless what it has is the
/// beginning of the range.
IndexRange remaining(const BakeState& state, IndexRange range, const std::string& file);
/// The same of samples; the state must be one of gathered direct light.
IndexRange remainingSamples(const BakeState& state, IndexRange range, const std::string& file);

/// Gathers and traces what is left of the job's ranges, in order, into `state`. Saves a state every checkpointSeconds
/// and at the end; one that fails is warned of and tried again at the next. `folder` may be null: nothing is saved.
void runJob(const BakeJob& job, BakeState& state, CheckpointFolder* folder);

/// Saves states of a running job when they are due.
class CheckpointWriter {
 public:
  CheckpointWriter(const BakeJob& job, CheckpointFolder* folder);
  bool due() const { return folder_ != nullptr && clock_.due(); }
  /// `state` is whole; what was done for that since `start` counts as part of the cost of saving. A failure is warned
  /// of.
  void save(BakeState& state, CheckpointClock::Clock::time_point start = CheckpointClock::Clock::now());
  /// At the end of the job: a failure is an Error where the job wants the state for itself.
  void saveLast(BakeState& state);

 private:
  void trySaving(BakeState& state);
  void addCost(BakeState& state, CheckpointClock::Clock::time_point start) const;

  const BakeJob& job_;
  CheckpointFolder* folder_;
  CheckpointClock clock_;
};

/// Adds the time since its making, at every call the time since the last one.
class TracingTime {
 public:
  void addTo(std::uint64_t& microseconds);

 private:
  CheckpointClock::Clock::time_point last_ = CheckpointClock::Clock::now();
};

}  // namespace lucarne
