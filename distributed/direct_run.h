// Gathers direct light in ranges of samples with all threads of this process.
#pragma once

#include <functional>
#include <memory>

#include "dlm/direct_gather.h"

namespace lucarne {

/// A range of samples is gathered in chunks, whole samples of all texels each: what was done is always a beginning of
/// the range. Adds are integers, so the result is the same for every number of threads and every cut.
class DirectRun {
 public:
  /// All must outlive this; `tallies` have a second set.
  DirectRun(const DirectGather& gather, int threads, const Tallies& tallies);
  ~DirectRun();
  DirectRun(const DirectRun&) = delete;
  DirectRun& operator=(const DirectRun&) = delete;

  /// `goOn` is asked after each chunk of about half a second, or one sample where that takes longer. Returns how many
  /// samples, from the beginning of the range, were gathered.
  std::uint64_t gather(IndexRange range, const std::function<bool()>& goOn);

  /// Adds what happened since the last call.
  void collect(DirectCounts& counts);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lucarne
