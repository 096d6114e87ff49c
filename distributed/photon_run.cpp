#include "distributed/photon_run.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "base/error.h"
#include "base/float_mode.h"
#include "tracer/transport/photon_tracer.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kLargestChunk = 4096, kSmallestChunk = 64;

/// What threads take from a batch: taken in order, and always finished. `chunk` at a time.
struct Batch {
  IndexRange range;
  std::uint64_t chunk;
  std::atomic<std::uint64_t> taken{0};  // from the beginning of the range: an index past its end may not fit 64 bits

  Batch(IndexRange range_, std::size_t threads)
      : range(range_), chunk(std::clamp<std::uint64_t>(range.size() / (8 * threads), kSmallestChunk, kLargestChunk)) {}
  /// What was taken is a beginning of the range.
  std::uint64_t done() const { return std::min(taken.load(), range.size()); }
};

/// One thread's sink over its tallies, kept from batch to batch.
class Worker {
 public:
  virtual ~Worker() = default;
  virtual void take(Batch& batch) = 0;
  /// Everything this worker did since the last reset, deposits included.
  virtual Ledger ledger() const = 0;
  virtual void reset() = 0;
};

template <bool shared, bool moments, bool linear>
class SinkWorker final : public Worker {
 public:
  SinkWorker(const PhotonTask& task, const PhotonRunOptions& options, const Tallies& tallies)
      : task_(task), options_(options), sink_(task.map, task.layout, task.directions, options.part, tallies) {}

  void take(Batch& batch) override {
    const FlushDenormals mode;
    const IndexRange range = batch.range;
    while (!options_.stop || !options_.stop()) {
      const std::uint64_t offset = batch.taken.fetch_add(batch.chunk, std::memory_order_relaxed);
      if (offset >= range.size()) break;
      const std::uint64_t begin = range.begin + offset, end = begin + std::min(batch.chunk, range.size() - offset);
      tracePhotons(task_.scene, {begin, end}, options_.seed, options_.limits, sink_, ledger_);
    }
    sink_.flush();
  }

  Ledger ledger() const override {
    Ledger all = ledger_;
    all.incident += sink_.sums().incident;
    all.storedHits += sink_.sums().storedHits;
    all.clampedNormals += sink_.sums().clamped;
    return all;
  }

  void reset() override {
    ledger_ = {};
    sink_.resetSums();
  }

 private:
  const PhotonTask& task_;
  const PhotonRunOptions& options_;
  DepositSink<shared, moments, linear> sink_;
  Ledger ledger_;
};

/// Batches grow until one takes about a quarter of a second: progress stays lively and the barrier between costs
/// little.
class BatchSize {
 public:
  std::uint64_t next() const { return size_; }
  void took(double seconds) {
    if (seconds < 0.125 && size_ < kLargest) size_ *= 2;
    if (seconds > 0.5 && size_ > kSmallest) size_ /= 2;
  }

 private:
  static constexpr std::uint64_t kLargest = std::uint64_t{1} << 26, kSmallest = 512;
  std::uint64_t size_ = 32768;
};

}  // namespace

bool nearlyFull(const FluxSum& incident) {
  return std::any_of(incident.units.begin(), incident.units.end(),
                     [](const Int128 sum) { return sum >= (Int128{1} << 62); });
}

bool hasPrivateTallies(const TallyLayout& layout, const PhotonRunOptions& options) {
  const auto threads = static_cast<std::uint64_t>(options.threads);
  return threads > 1 && layout.bytes() * threads <= options.privateTallyBytes;
}

void checkTalliesFit(const FluxSum& incident) {
  for (const Int128 sum : incident.units)
    if (sum >= (Int128{1} << 63))
      throw Error(ExitCode::outOfResource,
                  "tallies are full: bake fewer photons, or in parts with their own light maps");
}

class PhotonRun::Impl {
 public:
  Impl(const PhotonTask& task, const PhotonRunOptions& options, Tallies& tallies)
      : task_(task),
        options_(options),
        tallies_(tallies),
        allowed_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads)),
        arena_(options.threads) {
    const auto threads = static_cast<std::size_t>(options.threads);
    const bool shared = threads > 1 && !hasPrivateTallies(task.layout, options);
    copies_.reserve(threads);
    for (std::size_t i = 0; i < threads; ++i) {
      if (shared) {
        workers_.push_back(makeWorker<true>(tallies_));
      } else {
        workers_.push_back(makeWorker<false>(i == 0 ? tallies_ : copies_.emplace_back(task.layout)));
      }
    }
  }

  std::uint64_t trace(IndexRange range, const std::function<bool(const RunProgress&)>& progress) {
    std::uint64_t done = range.begin;
    while (done < range.end) {
      const std::uint64_t size = std::min(batch_.next(), range.end - done), traced = traceBatch({done, done + size});
      done += traced;
      const Ledger sum = sumLedgers();
      checkTalliesFit(sum.incident);
      if (!progress({sum.photons, sum.rays}) || traced < size) break;
    }
    return done - range.begin;
  }

  void collect(Ledger& ledger) {
    ledger += sumLedgers();
    checkTalliesFit(ledger.incident);
    for (const auto& w : workers_) w->reset();
    for (Tallies& copy : copies_) {
      tallies_.add(copy);
      copy.clear();
    }
  }

 private:
  template <bool shared>
  std::unique_ptr<Worker> makeWorker(const Tallies& tallies) const {
    const bool moments = task_.layout.momentEntries > 0, linear = task_.directions.triangles() != nullptr;
    if (moments && linear) return makeWorkerOf<shared, true, true>(tallies);
    if (moments) return makeWorkerOf<shared, true, false>(tallies);
    if (linear) return makeWorkerOf<shared, false, true>(tallies);
    return makeWorkerOf<shared, false, false>(tallies);
  }
  template <bool shared, bool moments, bool linear>
  std::unique_ptr<Worker> makeWorkerOf(const Tallies& tallies) const {
    return std::make_unique<SinkWorker<shared, moments, linear>>(task_, options_, tallies);
  }

  /// How many, from the beginning of the range.
  std::uint64_t traceBatch(IndexRange range) {
    Batch batch(range, workers_.size());
    const auto start = std::chrono::steady_clock::now();
    arena_.execute([&] {
      tbb::parallel_for(
          std::size_t{0}, workers_.size(), [&](std::size_t w) { workers_[w]->take(batch); }, tbb::simple_partitioner());
    });
    if (batch.done() == range.size())
      batch_.took(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return batch.done();
  }

  Ledger sumLedgers() const {
    Ledger sum;
    for (const auto& w : workers_) sum += w->ledger();
    return sum;
  }

  const PhotonTask task_;
  const PhotonRunOptions options_;
  Tallies& tallies_;
  std::vector<Tallies> copies_;  // of all threads but the first, where they fit
  std::vector<std::unique_ptr<Worker>> workers_;
  tbb::global_control allowed_;
  tbb::task_arena arena_;
  BatchSize batch_;
};

PhotonRun::PhotonRun(const PhotonTask& task, const PhotonRunOptions& options, Tallies& tallies)
    : impl_(std::make_unique<Impl>(task, options, tallies)) {}
PhotonRun::~PhotonRun() = default;

std::uint64_t PhotonRun::trace(IndexRange range, const std::function<bool(const RunProgress&)>& progress) {
  return impl_->trace(range, progress);
}

void PhotonRun::collect(Ledger& ledger) { impl_->collect(ledger); }

std::uint64_t runPhotons(const PhotonTask& task, IndexRange range, const PhotonRunOptions& options, Tallies& tallies,
                         Ledger& ledger, const std::function<bool(const RunProgress&)>& progress) {
  PhotonRun run(task, options, tallies);
  const std::uint64_t done = run.trace(range, progress);
  run.collect(ledger);
  return done;
}

}  // namespace lucarne
