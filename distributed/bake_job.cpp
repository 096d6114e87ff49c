#include "distributed/bake_job.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "base/units.h"
#include "distributed/error_judge.h"

namespace lucarne {

namespace {

IndexRange rest(const IndexSet& held, IndexRange range, const std::string& what, const std::string& file) {
  if (held.empty()) return range;
  const IndexRange first = held.ranges().front();
  if (held.ranges().size() == 1 && first.begin == range.begin && first.end <= range.end) return {first.end, range.end};
  throw Error(ExitCode::mergeRefused, file + " holds " + what + " " + toText(held) +
                                          ", which are not the beginning of " + toText(IndexSet(range)) +
                                          "; ask for at least as many, or name another output");
}

}  // namespace

IndexRange remaining(const BakeState& state, IndexRange range, const std::string& file) {
  return rest(state.header.photons, range, "photons", file);
}

IndexRange remainingSamples(const BakeState& state, IndexRange range, const std::string& file) {
  return rest(state.header.direct.value().samples, range, "samples of direct light", file);
}

CheckpointWriter::CheckpointWriter(const BakeJob& job, CheckpointFolder* folder)
    : job_(job), folder_(job.checkpointSeconds > 0 ? folder : nullptr), clock_(job.checkpointSeconds) {}

void CheckpointWriter::save(BakeState& state, CheckpointClock::Clock::time_point start) {
  const double before = state.checkpointSeconds;
  trySaving(state);
  addCost(state, start);
  clock_.saved(state.checkpointSeconds - before);
}

bool CheckpointWriter::saveLast(BakeState& state) {
  if (folder_ == nullptr) return false;
  const auto start = CheckpointClock::Clock::now();
  const bool saved = trySaving(state);
  addCost(state, start);
  return saved;
}

bool CheckpointWriter::trySaving(BakeState& state) {
  try {
    folder_->save(state.header, job_.scene, state.tallies);
    if (std::exchange(failed_, false)) logInfo("states are saved again");
    return true;
  } catch (const Error& error) {
    failed_ = true;
    logWarning(std::string("no state saved: ") + error.what() + "; the bake goes on without");
    return false;
  }
}

void CheckpointWriter::addCost(BakeState& state, CheckpointClock::Clock::time_point start) const {
  ++state.checkpoints;
  state.checkpointSeconds += std::chrono::duration<double>(CheckpointClock::Clock::now() - start).count();
}

void TracingTime::addTo(std::uint64_t& microseconds) {
  const auto now = CheckpointClock::Clock::now();
  microseconds +=
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now - last_).count());
  last_ = now;
}

bool isOver(const BakeJob& job, std::uint64_t photons) {
  return photons >= kFewestPhotons && CheckpointClock::Clock::now() >= job.rules.deadline;
}

namespace {

/// The job of one process.
class Runner {
 public:
  Runner(const BakeJob& job, BakeState& state, CheckpointFolder* folder)
      : job_(job), state_(state), writer_(job, folder), judge_(job, state.header.photons.count()) {}

  JobResult run() {
    JobEnd end = JobEnd::photons;
    if (job_.direct && !gatherDirect()) end = JobEnd::interrupted;
    if (end == JobEnd::photons) end = tracePhotons();
    return {end, writer_.saveLast(state_)};
  }

 private:
  void tell(const RunProgress& p) const {
    const std::uint64_t samples = state_.header.direct ? state_.header.direct->samples.count() : 0;
    job_.progress({p, samples, writer_.untilDue()});
  }

  /// What is asked of a state between two pieces of work, when its tallies are whole.
  void serve() {
    if (std::exchange(previewWanted_, false) && job_.preview) job_.preview(state_);
    if (writer_.due()) writer_.save(state_);
    time_ = {};  // what this took is not tracing
  }

  bool asked() {
    previewWanted_ = previewWanted_ || job_.control.takePreview();
    return previewWanted_ || writer_.due() || job_.control.stop();
  }

  /// False when it was stopped.
  bool gatherDirect() {
    DirectPart& direct = state_.header.direct.value();
    DirectRun run(job_.direct->gather, job_.run.threads, state_.tallies);
    IndexRange left = remainingSamples(state_, job_.direct->range, "the state");
    time_ = {};
    while (left.size() > 0) {
      if (job_.control.stop()) return false;
      const std::uint64_t gathered = run.gather(left, [&] { return !asked(); });
      run.collect(direct.counts);
      direct.samples.add({left.begin, left.begin + gathered});
      left.begin += gathered;
      time_.addTo(direct.microseconds);
      tell({state_.header.photons.count(), state_.header.ledger.rays});
      serve();
    }
    return true;
  }

  JobEnd tracePhotons() {
    std::optional<PhotonRun> run;
    IndexRange left = remaining(state_, job_.range, "the state");
    PhotonRunOptions options = job_.run;
    options.stop = job_.control.stop;
    time_ = {};
    for (;;) {
      const std::uint64_t photons = state_.header.photons.count();
      if (judge_.due(photons) && judge_.judge(state_)) return JobEnd::targetError;
      if (left.size() == 0) return JobEnd::photons;
      if (nearlyFull(state_.header.ledger.incident)) return JobEnd::talliesFull;
      if (isOver(job_, photons)) return JobEnd::time;
      if (job_.control.stop()) return JobEnd::interrupted;
      if (previewWanted_) run.reset();  // maps need the memory that threads' own tallies take
      serve();
      if (!run) run.emplace(job_.task, options, state_.tallies);
      tracePiece(*run, left);
    }
  }

  void tracePiece(PhotonRun& run, IndexRange& left) {
    const RunProgress before{state_.header.photons.count(), state_.header.ledger.rays};
    const std::uint64_t size = std::min(left.size(), judge_.limit(before.photons) - before.photons);
    const std::uint64_t traced = run.trace({left.begin, left.begin + size}, [&](const RunProgress& p) {
      const std::uint64_t photons = before.photons + p.photons;
      tell({photons, before.rays + p.rays});
      return !asked() && !isOver(job_, photons) && !(job_.rules.targetError == 0 && judge_.due(photons));
    });
    run.collect(state_.header.ledger);
    state_.header.photons.add({left.begin, left.begin + traced});
    left.begin += traced;
    time_.addTo(state_.header.microseconds);
  }

  const BakeJob& job_;
  BakeState& state_;
  CheckpointWriter writer_;
  ErrorJudge judge_;
  TracingTime time_;
  bool previewWanted_ = false;
};

}  // namespace

JobResult runJob(const BakeJob& job, BakeState& state, CheckpointFolder* folder) {
  return Runner(job, state, folder).run();
}

}  // namespace lucarne
