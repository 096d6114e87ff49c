#include "distributed/mpi/mpi_root.h"

#include <atomic>
#include <chrono>
#include <future>

#include "distributed/mpi/mpi_call.h"
#include "distributed/mpi/mpi_protocol.h"
#include "distributed/mpi/mpi_sum.h"
#include "distributed/range_dealer.h"

namespace lucarne {
namespace {

using Clock = std::chrono::steady_clock;

/// Rank 0's own tracing, in a thread beside the one that talks to MPI.
class OwnTracing {
 public:
  OwnTracing(const BakeJob& job, Tallies& tallies) : run_(job.task, job.run, tallies) {}

  bool busy() const { return future_.valid(); }
  void start(IndexRange range) {
    range_ = range;
    start_ = Clock::now();
    future_ = std::async(std::launch::async, [this, range] {
      run_.trace(range, [this](const RunProgress& p) {
        photons_ = p.photons;
        rays_ = p.rays;
        return true;
      });
    });
  }
  /// The report of what start() began, once it is done; rethrows what went wrong.
  std::optional<RankReport> finished() {
    if (future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    future_.get();
    return RankReport{range_.size(), 0, std::chrono::duration<double>(Clock::now() - start_).count()};
  }
  void collect(Ledger& ledger) {
    run_.collect(ledger);
    photons_ = rays_ = 0;
  }
  RunProgress sinceCollected() const { return {photons_, rays_}; }

 private:
  PhotonRun run_;
  IndexRange range_;
  Clock::time_point start_;
  std::atomic<std::uint64_t> photons_{0}, rays_{0};
  std::future<void> future_;
};

class Root {
 public:
  Root(MPI_Comm comm, const BakeJob& job, BakeState& state, CheckpointFolder* folder, int ranks)
      : comm_(comm),
        job_(job),
        state_(state),
        ranks_(ranks),
        range_(remaining(state, job.range, "the state")),
        dealer_(range_, ranks),
        own_(job, state.tallies),
        writer_(job, folder),
        free_(static_cast<std::size_t>(ranks), false) {
    free_[0] = true;
  }

  void run() {
    for (;;) {
      const bool heard = listen();
      if (!collecting_ && writer_.due()) {
        collecting_ = true;
        collectingSince_ = Clock::now();
      }
      deal();
      if (allFree()) {
        collect();
        if (dealer_.empty()) break;
        // Ranks that waited for the slowest, and the sum, cost tracing time like the writing does.
        writer_.save(state_, collectingSince_);
        collecting_ = false;
        time_ = {};
        continue;
      }
      if (!heard) nap();
    }
    writer_.saveLast(state_);
    for (int rank = 1; rank < ranks_; ++rank) sendOrder(comm_, rank, {Order::end});
  }

 private:
  /// Takes in what has arrived. True if something had.
  bool listen() {
    bool heard = false;
    if (own_.busy()) {
      if (const auto report = own_.finished()) heard = take(0, *report);
    }
    while (const auto received = takeReport(comm_)) heard = take(received->rank, received->report);
    const RunProgress own = own_.sinceCollected();
    const Ledger& ledger = state_.header.ledger;
    job_.progress(
        {state_.header.photons.count() + others_.photons + own.photons, ledger.rays + others_.rays + own.rays});
    return heard;
  }

  bool take(int rank, const RankReport& report) {
    dealer_.finished(rank, report.photons, report.seconds);
    free_[static_cast<std::size_t>(rank)] = true;
    if (rank != 0) others_ = {others_.photons + report.photons, others_.rays + report.rays};
    return true;
  }

  void deal() {
    for (int rank = 0; rank < ranks_ && !collecting_ && !dealer_.empty(); ++rank) {
      if (!free_[static_cast<std::size_t>(rank)]) continue;
      const IndexRange piece = dealer_.next(rank);
      free_[static_cast<std::size_t>(rank)] = false;
      if (rank == 0) {
        own_.start(piece);
      } else {
        sendOrder(comm_, rank, {Order::trace, piece.begin, piece.end});
      }
    }
  }

  bool allFree() const {
    return std::all_of(free_.begin(), free_.end(), [](bool f) { return f; });
  }

  /// Every rank is free and told to add its tallies to ours; then it says again that it is free.
  void collect() {
    for (int rank = 1; rank < ranks_; ++rank) sendOrder(comm_, rank, {Order::collect});
    Ledger ledger;
    own_.collect(ledger);
    sumTallies(comm_, state_.tallies);
    sumLedgers(comm_, ledger);
    state_.header.ledger += ledger;
    checkTalliesFit(state_.header.ledger.incident);
    state_.header.photons.add({range_.begin, dealer_.begin()});
    range_.begin = dealer_.begin();
    others_ = {};
    time_.addTo(state_.header);
    for (int rank = 1; rank < ranks_; ++rank) free_[static_cast<std::size_t>(rank)] = false;
    while (!allFree())
      if (!listen()) nap();
  }

  MPI_Comm comm_;
  const BakeJob& job_;
  BakeState& state_;
  int ranks_;
  IndexRange range_;  // what is not yet in the state
  RangeDealer dealer_;
  OwnTracing own_;
  CheckpointWriter writer_;
  TracingTime time_;
  std::vector<bool> free_;
  bool collecting_ = false;
  Clock::time_point collectingSince_;
  RunProgress others_{0, 0};  // since the last collecting, of ranks 1 and up
};

}  // namespace

void runRoot(MPI_Comm comm, const BakeJob& job, BakeState& state, CheckpointFolder* folder) {
  int ranks = 1;
  checkMpi(MPI_Comm_size(comm, &ranks), "MPI_Comm_size");
  Root(comm, job, state, folder, ranks).run();
}

}  // namespace lucarne
