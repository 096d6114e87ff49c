// Which photons or samples each rank takes next. A slow rank gets fewer, and all end at about the same time.
#pragma once

#include <vector>

#include "tracer/transport/photon_hit.h"

namespace lucarne {

/// Deals a range out in order, so that what was dealt is always a beginning of it. A piece is about a second's work of
/// the rank that gets it, by the rate it showed, and at most its share of half of what is left (guided self-scheduling,
/// Polychronopoulos and Kuck 1987, halved).
class RangeDealer {
 public:
  /// The first piece of each rank, and the smallest that any gets while there is more left.
  struct Pieces {
    std::uint64_t first = 16384, smallest = 4096;
  };
  RangeDealer(IndexRange range, int ranks, Pieces pieces)
      : left_(range), pieces_(pieces), rates_(static_cast<std::size_t>(ranks), 0.0) {}
  RangeDealer(IndexRange range, int ranks) : RangeDealer(range, ranks, Pieces{}) {}
  /// The next piece; empty when all is dealt.
  IndexRange next(int rank);
  /// What the rank did with its last piece.
  void finished(int rank, std::uint64_t indices, double seconds);
  /// The range goes on to here.
  void extend(std::uint64_t end) { left_.end = end; }
  bool empty() const { return left_.size() == 0; }
  /// What was dealt ends here.
  std::uint64_t begin() const { return left_.begin; }

 private:
  static constexpr double kSeconds = 1;
  IndexRange left_;
  Pieces pieces_;
  std::vector<double> rates_;  // indices per second; 0: not known
};

}  // namespace lucarne
