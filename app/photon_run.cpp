#include "app/photon_run.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <mutex>

#include "base/error.h"
#include "base/float_mode.h"

namespace lucarne {
namespace {

constexpr std::uint64_t kChunk = 4096;

/// Everything that the workers share.
struct Run {
  const PhotonScene& scene;
  const TexelMap& map;
  const TallyLayout& layout;
  const DirectionSet& directions;
  const PhotonRunOptions& options;
};

/// One thread's sink over its tallies, kept from batch to batch.
template <bool shared>
class Worker {
 public:
  Worker(const Run& run, const Tallies& tallies) : run_(run), sink_(run.map, run.layout, run.directions, run.options.part, tallies) {}

  /// `taken` counts from the beginning of the range: an index past its end may not fit 64 bits.
  void take(std::atomic<std::uint64_t>& taken, IndexRange range) {
    const FlushDenormals mode;
    for (;;) {
      const std::uint64_t offset = taken.fetch_add(kChunk, std::memory_order_relaxed);
      if (offset >= range.size()) break;
      const std::uint64_t begin = range.begin + offset, end = begin + std::min(kChunk, range.size() - offset);
      tracePhotons(run_.scene, {begin, end}, run_.options.seed, run_.options.limits, sink_, ledger_);
    }
    sink_.flush();
  }

  const Ledger& traced() const { return ledger_; }
  /// Everything this worker did, deposits included.
  Ledger ledger() const {
    Ledger all = ledger_;
    all.incident += sink_.sums().incident;
    all.storedHits += sink_.sums().storedHits;
    all.clampedNormals += sink_.sums().clamped;
    return all;
  }

 private:
  const Run& run_;
  DepositSink<shared> sink_;
  Ledger ledger_;
};

/// No tally can overflow while the sum of all deposits fits 63 bits, since every deposit is ≥ 0. A batch that breaks the
/// bound is not used.
void checkOverflow(const FluxSum& incident) {
  for (const Int128 sum : incident.units)
    if (sum >= (Int128{1} << 63))
      throw Error(ExitCode::outOfResource, "tallies are full: bake fewer photons, or in parts with their own light maps");
}

template <class Workers>
Ledger sumLedgers(const Workers& workers) {
  Ledger sum;
  for (const auto& w : workers) sum += w->ledger();
  return sum;
}

/// Batches grow until one takes about a quarter of a second: progress stays lively and the barrier between costs little.
class BatchSize {
 public:
  std::uint64_t next() const { return size_; }
  void took(double seconds) {
    if (seconds < 0.125 && size_ < kLargest) size_ *= 2;
    if (seconds > 0.5 && size_ > kChunk) size_ /= 2;
  }

 private:
  static constexpr std::uint64_t kLargest = std::uint64_t{1} << 26;
  std::uint64_t size_ = 8 * kChunk;
};

template <bool shared>
std::uint64_t runBatches(const Run& run, IndexRange range, const std::vector<const Tallies*>& tallies, Ledger& ledger,
                         const std::function<bool(const RunProgress&)>& progress) {
  std::vector<std::unique_ptr<Worker<shared>>> workers;
  for (const Tallies* t : tallies) workers.push_back(std::make_unique<Worker<shared>>(run, *t));
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(run.options.threads));
  tbb::task_arena arena(run.options.threads);
  BatchSize batch;
  std::uint64_t done = range.begin;
  while (done < range.end) {
    const std::uint64_t end = done + std::min(batch.next(), range.end - done);
    std::atomic<std::uint64_t> taken{0};
    const auto start = std::chrono::steady_clock::now();
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, workers.size(), [&](std::size_t w) { workers[w]->take(taken, {done, end}); }, tbb::simple_partitioner());
    });
    batch.took(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    done = end;
    const Ledger sum = sumLedgers(workers);
    checkOverflow(sum.incident);
    if (!progress({done - range.begin, sum.rays})) break;
  }
  ledger += sumLedgers(workers);
  return done - range.begin;
}

}  // namespace

std::uint64_t runPhotons(const PhotonScene& scene, const TexelMap& map, const TallyLayout& layout, const DirectionSet& directions,
                         IndexRange range, const PhotonRunOptions& options, Tallies& tallies, Ledger& ledger,
                         const std::function<bool(const RunProgress&)>& progress) {
  const Run run{scene, map, layout, directions, options};
  const auto threads = static_cast<std::size_t>(options.threads);
  if (threads == 1) return runBatches<false>(run, range, {&tallies}, ledger, progress);
  if (layout.bytes() * threads > options.privateTallyBytes)
    return runBatches<true>(run, range, std::vector<const Tallies*>(threads, &tallies), ledger, progress);
  std::vector<Tallies> copies;
  std::vector<const Tallies*> each{&tallies};
  copies.reserve(threads);
  for (std::size_t i = 1; i < threads; ++i) each.push_back(&copies.emplace_back(layout));
  const std::uint64_t done = runBatches<false>(run, range, each, ledger, progress);
  for (const Tallies& copy : copies) tallies.add(copy);
  return done;
}

}  // namespace lucarne
