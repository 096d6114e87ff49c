#include "distributed/bake_job.h"

#include "base/error.h"
#include "base/log.h"
#include "base/units.h"

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

void CheckpointWriter::saveLast(BakeState& state) {
  if (folder_ == nullptr) return;
  const auto start = CheckpointClock::Clock::now();
  if (job_.lastStateIsWanted) {
    folder_->save(state.header, job_.scene, state.tallies);
  } else {
    trySaving(state);
  }
  addCost(state, start);
}

void CheckpointWriter::trySaving(BakeState& state) {
  try {
    folder_->save(state.header, job_.scene, state.tallies);
  } catch (const Error& error) {
    logWarning(std::string("no state saved: ") + error.what() + "; the bake goes on without");
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

namespace {

void gatherDirect(const BakeJob& job, BakeState& state, CheckpointWriter& writer) {
  DirectPart& direct = state.header.direct.value();
  DirectRun run(job.direct->gather, job.run.threads, state.tallies);
  IndexRange left = remainingSamples(state, job.direct->range, "the state");
  TracingTime time;
  while (left.size() > 0) {
    const std::uint64_t gathered = run.gather(left, [&] { return !writer.due(); });
    run.collect(direct.counts);
    direct.samples.add({left.begin, left.begin + gathered});
    left.begin += gathered;
    time.addTo(direct.microseconds);
    if (writer.due()) writer.save(state);
    time = {};
  }
}

void tracePhotons(const BakeJob& job, BakeState& state, CheckpointWriter& writer) {
  PhotonRun run(job.task, job.run, state.tallies);
  IndexRange left = remaining(state, job.range, "the state");
  TracingTime time;
  while (left.size() > 0) {
    const RunProgress before{state.header.photons.count(), state.header.ledger.rays};
    const std::uint64_t traced = run.trace(left, [&](const RunProgress& p) {
      job.progress({before.photons + p.photons, before.rays + p.rays});
      return !writer.due();
    });
    run.collect(state.header.ledger);
    state.header.photons.add({left.begin, left.begin + traced});
    left.begin += traced;
    time.addTo(state.header.microseconds);
    if (left.size() > 0) writer.save(state);
    // What saving took is not tracing.
    time = {};
  }
}

}  // namespace

void runJob(const BakeJob& job, BakeState& state, CheckpointFolder* folder) {
  CheckpointWriter writer(job, folder);
  if (job.direct) gatherDirect(job, state, writer);
  tracePhotons(job, state, writer);
  writer.saveLast(state);
}

}  // namespace lucarne
