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

/// Rank 0's own work, in a thread beside the one that talks to MPI.
class OwnWork {
 public:
  OwnWork(const BakeJob& job, Tallies& tallies) : run_(job.task, job.run, tallies) {
    if (job.direct) direct_.emplace(job.direct->gather, job.run.threads, tallies);
  }

  bool busy() const { return future_.valid(); }
  void start(Order order, IndexRange range) {
    range_ = range;
    start_ = Clock::now();
    future_ =
        std::async(std::launch::async, [this, order, range] { order == Order::gather ? gather(range) : trace(range); });
  }
  /// The report of what start() began, once it is done; rethrows what went wrong.
  std::optional<RankReport> finished() {
    if (future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    future_.get();
    return RankReport{range_.size(), 0, std::chrono::duration<double>(Clock::now() - start_).count()};
  }
  void collect(Ledger& ledger, DirectCounts& counts) {
    run_.collect(ledger);
    if (direct_) direct_->collect(counts);
    photons_ = rays_ = 0;
  }
  RunProgress sinceCollected() const { return {photons_, rays_}; }

 private:
  void gather(IndexRange range) {
    direct_.value().gather(range, [] { return true; });
  }
  void trace(IndexRange range) {
    run_.trace(range, [this](const RunProgress& p) {
      photons_ = p.photons;
      rays_ = p.rays;
      return true;
    });
  }

  PhotonRun run_;
  std::optional<DirectRun> direct_;
  IndexRange range_;
  Clock::time_point start_;
  std::atomic<std::uint64_t> photons_{0}, rays_{0};
  std::future<void> future_;
};

/// What is left of one kind of work: `left` is not yet in the state.
struct Deal {
  IndexRange left;
  RangeDealer dealer;
  Deal(IndexRange range, int ranks, RangeDealer::Pieces pieces) : left(range), dealer(range, ranks, pieces) {}
  /// What was dealt since the last call.
  IndexRange take() {
    const IndexRange taken{left.begin, dealer.begin()};
    left.begin = dealer.begin();
    return taken;
  }
};

class Root {
 public:
  Root(MPI_Comm comm, const BakeJob& job, BakeState& state, CheckpointFolder* folder, int ranks)
      : comm_(comm),
        job_(job),
        state_(state),
        ranks_(ranks),
        samples_(job.direct ? remainingSamples(state, job.direct->range, "the state") : IndexRange{}, ranks, {1, 1}),
        photons_(remaining(state, job.range, "the state"), ranks, {}),
        own_(job, state.tallies),
        writer_(job, folder),
        free_(static_cast<std::size_t>(ranks), false),
        doing_(static_cast<std::size_t>(ranks), Order::trace) {
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
        if (allDealt()) break;
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
    const Order order = doing_[static_cast<std::size_t>(rank)];
    (order == Order::gather ? samples_ : photons_).dealer.finished(rank, report.count, report.seconds);
    free_[static_cast<std::size_t>(rank)] = true;
    if (rank != 0 && order == Order::trace) others_ = {others_.photons + report.count, others_.rays + report.rays};
    return true;
  }

  bool allDealt() const { return samples_.dealer.empty() && photons_.dealer.empty(); }

  void deal() {
    for (int rank = 0; rank < ranks_ && !collecting_ && !allDealt(); ++rank) {
      if (!free_[static_cast<std::size_t>(rank)]) continue;
      const Order order = samples_.dealer.empty() ? Order::trace : Order::gather;
      const IndexRange piece = (order == Order::gather ? samples_ : photons_).dealer.next(rank);
      free_[static_cast<std::size_t>(rank)] = false;
      doing_[static_cast<std::size_t>(rank)] = order;
      if (rank == 0) {
        own_.start(order, piece);
      } else {
        sendOrder(comm_, rank, {order, piece.begin, piece.end});
      }
      // From here on time is that of photons.
      if (order == Order::gather && samples_.dealer.empty()) time_.addTo(state_.header.direct->microseconds);
    }
  }

  bool allFree() const {
    return std::all_of(free_.begin(), free_.end(), [](bool f) { return f; });
  }

  /// Every rank is free and told to add its tallies to ours; then it says again that it is free.
  void collect() {
    for (int rank = 1; rank < ranks_; ++rank) sendOrder(comm_, rank, {Order::collect});
    Ledger ledger;
    DirectCounts counts;
    own_.collect(ledger, counts);
    sumTallies(comm_, state_.tallies);
    sumLedgers(comm_, ledger);
    PartHeader& header = state_.header;
    header.ledger += ledger;
    checkTalliesFit(header.ledger.incident);
    header.photons.add(photons_.take());
    if (header.direct) {
      sumCounts(comm_, counts);
      header.direct->counts += counts;
      header.direct->samples.add(samples_.take());
    }
    others_ = {};
    time_.addTo(samples_.dealer.empty() ? header.microseconds : header.direct->microseconds);
    for (int rank = 1; rank < ranks_; ++rank) free_[static_cast<std::size_t>(rank)] = false;
    while (!allFree())
      if (!listen()) nap();
  }

  MPI_Comm comm_;
  const BakeJob& job_;
  BakeState& state_;
  int ranks_;
  Deal samples_, photons_;
  OwnWork own_;
  CheckpointWriter writer_;
  TracingTime time_;
  std::vector<bool> free_;
  std::vector<Order> doing_;  // last
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
