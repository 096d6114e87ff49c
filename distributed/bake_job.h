// A bake as work: which samples of direct light are still to be gathered and which photons to be traced, and a state
// that is saved on the way.
#pragma once

#include <functional>

#include "distributed/checkpoint.h"
#include "distributed/direct_run.h"
#include "distributed/job_control.h"
#include "distributed/photon_run.h"

namespace lucarne {

/// Direct light to be gathered, before photons are traced.
struct DirectJob {
  const DirectGather& gather;
  IndexRange range;  // of samples in all, those of earlier runs included
};

struct BakeState;

/// How far a job is, earlier runs included.
struct JobProgress : RunProgress {
  std::uint64_t samples = 0;    // of direct light
  double untilCheckpoint = -1;  // seconds; negative: none is to come
};

struct EstimatedError {
  double error;           // estimated relative error
  std::uint64_t photons;  // of so many
  double seconds;         // that it took to say so; nothing was traced meanwhile
};

struct BakeJob {
  PhotonTask task;
  PhotonRunOptions run;
  IndexRange range;                     // of photons in all, those of earlier runs included
  std::span<const std::uint8_t> scene;  // packed, as states carry it
  double checkpointSeconds = 300;       // 0: no states
  std::function<void(const JobProgress&)> progress;
  std::optional<DirectJob> direct = {};
  StopRules rules = {};
  JobControl control = {};
  std::function<void(BakeState&)> preview = {};                // called where one was asked for, with whole tallies
  std::function<double(const BakeState&)> estimateError = {};  // estimated relative error of what there is
  std::function<void(const EstimatedError&)> estimated = {};  // told of every estimate
};

struct JobResult {
  JobEnd end = JobEnd::photons;
  bool saved = false;  // all that the state holds is in the folder of states
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

/// Gathers and traces what is left of the job's ranges, in order, into `state`, until they are done or something else
/// ends it. Saves a state every checkpointSeconds and at the end; one that fails is warned of and tried again at the
/// next. `folder` may be null: nothing is saved.
JobResult runJob(const BakeJob& job, BakeState& state, CheckpointFolder* folder);

/// True from when the job has had its time, given that it has traced so many photons.
bool isOver(const BakeJob& job, std::uint64_t photons);

/// Saves states of a running job when they are due.
class CheckpointWriter {
 public:
  CheckpointWriter(const BakeJob& job, CheckpointFolder* folder);
  bool due() const { return folder_ != nullptr && clock_.due(); }
  /// Seconds, for JobProgress.
  double untilDue() const { return folder_ != nullptr ? clock_.untilDue() : -1; }
  /// `state` is whole; what was done for that since `start` counts as part of the cost of saving. A failure is warned
  /// of.
  void save(BakeState& state, CheckpointClock::Clock::time_point start = CheckpointClock::Clock::now());
  /// At the end of the job. True if the state is saved.
  bool saveLast(BakeState& state);

 private:
  bool trySaving(BakeState& state);
  void addCost(BakeState& state, CheckpointClock::Clock::time_point start) const;

  const BakeJob& job_;
  CheckpointFolder* folder_;
  CheckpointClock clock_;
  bool failed_ = false;  // the last time
};

/// Adds the time since its making, at every call the time since the last one.
class TracingTime {
 public:
  void addTo(std::uint64_t& microseconds);

 private:
  CheckpointClock::Clock::time_point last_ = CheckpointClock::Clock::now();
};

}  // namespace lucarne
