#include "distributed/bake_job.h"

#include "base/error.h"
#include "base/log.h"
#include "base/units.h"

namespace lucarne {

IndexRange remaining(const BakeState& state, IndexRange range, const std::string& file) {
  const IndexSet& photons = state.header.photons;
  if (photons.empty()) return range;
  const IndexRange first = photons.ranges().front();
  if (photons.ranges().size() == 1 && first.begin == range.begin && first.end <= range.end)
    return {first.end, range.end};
  throw Error(ExitCode::mergeRefused, file + " holds photons " + toText(photons) + ", which are not the beginning of " +
                                          toText(IndexSet(range)) +
                                          "; ask for at least as many, or name another output");
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

void TracingTime::addTo(PartHeader& header) {
  const auto now = CheckpointClock::Clock::now();
  header.microseconds +=
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now - last_).count());
  last_ = now;
}

void runJob(const BakeJob& job, BakeState& state, CheckpointFolder* folder) {
  CheckpointWriter writer(job, folder);
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
    time.addTo(state.header);
    if (left.size() > 0) writer.save(state);
    // What saving took is not tracing.
    time = {};
  }
  writer.saveLast(state);
}

}  // namespace lucarne
