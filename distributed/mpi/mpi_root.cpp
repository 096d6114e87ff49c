#include "distributed/mpi/mpi_root.h"

#include <atomic>
#include <chrono>
#include <future>
#include <utility>

#include "distributed/error_judge.h"
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
  OwnWork(const BakeJob& job, Tallies& tallies) : job_(job), tallies_(tallies) {
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
    if (run_) run_->collect(ledger);
    if (direct_) direct_->collect(counts);
    photons_ = rays_ = 0;
  }
  /// After collecting: gives back what threads' own tallies take, until there is more to trace.
  void rest() { run_.reset(); }
  RunProgress sinceCollected() const { return {photons_, rays_}; }

 private:
  void gather(IndexRange range) {
    direct_.value().gather(range, [] { return true; });
  }
  void trace(IndexRange range) {
    if (!run_) run_.emplace(job_.task, job_.run, tallies_);
    run_->trace(range, [this](const RunProgress& p) {
      photons_ = p.photons;
      rays_ = p.rays;
      return true;
    });
  }

  const BakeJob& job_;
  Tallies& tallies_;
  std::optional<PhotonRun> run_;
  std::optional<DirectRun> direct_;
  IndexRange range_;
  Clock::time_point start_;
  std::atomic<std::uint64_t> photons_{0}, rays_{0};
  std::future<void> future_;
};

/// What is left of one kind of work: `left` is not yet in the state, and dealt up to a limit.
struct Deal {
  IndexRange left;
  RangeDealer dealer;
  Deal(IndexRange range, int ranks, RangeDealer::Pieces pieces) : left(range), dealer(range, ranks, pieces) {}
  /// No more than so many are dealt, until the next call.
  void limit(std::uint64_t size) { dealer.extend(left.begin + std::min(left.size(), size)); }
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
        judge_(job, state.header.photons.count()),
        free_(static_cast<std::size_t>(ranks), false),
        doing_(static_cast<std::size_t>(ranks), Order::trace) {
    free_[0] = true;
  }

  JobResult run() {
    waitForAll();
    std::optional<JobEnd> end = ended();
    while (!end) {
      const bool heard = listen();
      if (!collecting_ && (dealt() || asked())) {
        collecting_ = true;
        collectingSince_ = Clock::now();
      }
      deal();
      if (!allFree()) {
        if (!heard) nap();
        continue;
      }
      if (!collecting_ && !dealt()) continue;
      collect();
      end = ended();
      if (!end) serve();
    }
    const JobResult result{*end, writer_.saveLast(state_)};
    for (int rank = 1; rank < ranks_; ++rank) sendOrder(comm_, rank, {Order::end});
    return result;
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
    const PartHeader& header = state_.header;
    traced_ = header.photons.count() + others_.photons + own.photons;
    job_.progress({{traced_, header.ledger.rays + others_.rays + own.rays},
                   header.direct ? header.direct->samples.count() : 0,
                   writer_.untilDue()});
    return heard;
  }

  /// Whether the job is at its end; asked when all tallies are in the state.
  std::optional<JobEnd> ended() {
    const std::uint64_t photons = state_.header.photons.count();
    photons_.limit(judge_.limit(photons) - photons);
    if (photons_.left.size() + samples_.left.size() > 0 && stopped()) return JobEnd::interrupted;
    if (samples_.left.size() > 0) return std::nullopt;
    if (judge_.due(photons) && judge_.judge(state_)) return JobEnd::targetError;
    if (photons_.left.size() == 0) return JobEnd::photons;
    if (nearlyFull(state_.header.ledger.incident)) return JobEnd::talliesFull;
    if (isOver(job_, photons)) return JobEnd::time;
    return std::nullopt;
  }

  bool stopped() {
    stopped_ = stopped_ || job_.control.stop();
    return stopped_;
  }

  bool asked() {
    previewWanted_ = previewWanted_ || job_.control.takePreview();
    if (previewWanted_ || writer_.due() || stopped()) return true;
    if (!samples_.dealer.empty()) return false;
    return isOver(job_, traced_) || (job_.rules.targetError == 0 && judge_.due(traced_));
  }

  /// What is asked of a state between two pieces of work, when all tallies are in it.
  void serve() {
    if (std::exchange(previewWanted_, false) && job_.preview) {
      own_.rest();
      job_.preview(state_);
    }
    // Ranks that waited for the slowest, and the sum, cost tracing time like the writing does.
    if (writer_.due()) writer_.save(state_, collectingSince_);
    collecting_ = false;
    time_ = {};
  }

  bool take(int rank, const RankReport& report) {
    const Order order = doing_[static_cast<std::size_t>(rank)];
    stopped_ = stopped_ || report.stop != 0;
    (order == Order::gather ? samples_ : photons_).dealer.finished(rank, report.count, report.seconds);
    free_[static_cast<std::size_t>(rank)] = true;
    if (rank != 0 && order == Order::trace) others_ = {others_.photons + report.count, others_.rays + report.rays};
    return true;
  }

  /// Up to the limit.
  bool dealt() const { return samples_.dealer.empty() && photons_.dealer.empty(); }

  void deal() {
    for (int rank = 0; rank < ranks_ && !collecting_ && !dealt(); ++rank) {
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
    waitForAll();
  }

  void waitForAll() {
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
  ErrorJudge judge_;
  TracingTime time_;
  std::vector<bool> free_;
  std::vector<Order> doing_;  // last
  bool collecting_ = false, previewWanted_ = false, stopped_ = false;
  std::uint64_t traced_ = 0;  // photons, as far as known
  Clock::time_point collectingSince_;
  RunProgress others_{0, 0};  // since the last collecting, of ranks 1 and up
};

}  // namespace

JobResult runRoot(MPI_Comm comm, const BakeJob& job, BakeState& state, CheckpointFolder* folder) {
  int ranks = 1;
  checkMpi(MPI_Comm_size(comm, &ranks), "MPI_Comm_size");
  return Root(comm, job, state, folder, ranks).run();
}

}  // namespace lucarne
