#include "distributed/direct_run.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <utility>

namespace lucarne {
namespace {

/// Samples a chunk: clipping the texels' surface costs about as much as one.
class ChunkSize {
 public:
  std::uint64_t next() const { return size_; }
  void took(double seconds) {
    if (seconds < 0.25 && size_ < kLargest) size_ *= 2;
    if (seconds > 1 && size_ > 1) size_ /= 2;
  }

 private:
  static constexpr std::uint64_t kLargest = 4096;
  std::uint64_t size_ = 4;
};

}  // namespace

class DirectRun::Impl {
 public:
  Impl(const DirectGather& gather, int threads, const Tallies& tallies)
      : gather_(gather),
        tallies_(tallies),
        allowed_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena_(threads) {}

  std::uint64_t gather(IndexRange range, const std::function<bool()>& goOn) {
    std::uint64_t done = range.begin;
    while (done < range.end) {
      const std::uint64_t end = done + std::min(chunk_.next(), range.end - done);
      const auto start = std::chrono::steady_clock::now();
      arena_.execute([&] { counts_ += gather_.gather({done, end}, tallies_); });
      chunk_.took(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      done = end;
      if (!goOn()) break;
    }
    return done - range.begin;
  }

  DirectCounts take() { return std::exchange(counts_, {}); }

 private:
  const DirectGather& gather_;
  const Tallies& tallies_;
  DirectCounts counts_;
  tbb::global_control allowed_;
  tbb::task_arena arena_;
  ChunkSize chunk_;
};

DirectRun::DirectRun(const DirectGather& gather, int threads, const Tallies& tallies)
    : impl_(std::make_unique<Impl>(gather, threads, tallies)) {}
DirectRun::~DirectRun() = default;

std::uint64_t DirectRun::gather(IndexRange range, const std::function<bool()>& goOn) {
  return impl_->gather(range, goOn);
}

void DirectRun::collect(DirectCounts& counts) { counts += impl_->take(); }

}  // namespace lucarne
