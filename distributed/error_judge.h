// When a running job's error is estimated, and whether that ends it.
#pragma once

#include <chrono>
#include <cstdint>

#include "distributed/job_control.h"

namespace lucarne {

struct BakeJob;
struct BakeState;

/// Where there is a target, at every count of photons at which it is judged, no other. Where there is none, now and
/// then for whoever watches, so rarely that it takes no more than a fiftieth of the time.
class ErrorJudge {
 public:
  /// `job` must outlive this. `photons`: what the state holds at the start.
  ErrorJudge(const BakeJob& job, std::uint64_t photons);
  /// Tracing goes no further than this count in one go.
  std::uint64_t limit(std::uint64_t photons) const;
  /// True where judge() is to be called before the next photon: the state's tallies must be whole then.
  bool due(std::uint64_t photons) const;
  /// True when the target is reached. Tells the job's `estimated`.
  bool judge(const BakeState& state);

 private:
  using Clock = std::chrono::steady_clock;
  const BakeJob& job_;
  std::uint64_t judged_ = 0;  // photons at the last time
  Clock::time_point last_ = Clock::now();
  double pause_;  // seconds until an estimate for watching is worth it
};

}  // namespace lucarne
