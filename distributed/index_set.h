// Sets of photon indices: what a part holds, what is missing, what two parts share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracer/transport/photon_hit.h"

namespace lucarne {

/// Disjoint half-open ranges, ascending, none empty, none touching the next.
class IndexSet {
 public:
  IndexSet() = default;
  explicit IndexSet(IndexRange range) { add(range); }

  /// The range must share nothing with the set (a std::logic_error, since a photon would be counted twice).
  void add(IndexRange range);
  void add(const IndexSet& other);

  const std::vector<IndexRange>& ranges() const { return ranges_; }
  bool empty() const { return ranges_.empty(); }
  std::uint64_t count() const;
  /// Of the odd ones among them.
  std::uint64_t countOdd() const;
  /// One past the largest index; 0 when empty.
  std::uint64_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }
  bool contains(IndexRange range) const;
  /// What both hold.
  IndexSet common(const IndexSet& other) const;
  /// What of `range` is not in the set.
  IndexSet missing(IndexRange range) const;

  friend bool operator==(const IndexSet& a, const IndexSet& b);

 private:
  std::vector<IndexRange> ranges_;
};

/// Range K of N of `photons` indices, K from 1: contiguous, and the N of them hold every index once. 1 ≤ K ≤ N.
IndexRange shareOf(std::uint64_t photons, std::uint64_t k, std::uint64_t n);

/// "0..2.5M, 5M..7.5M": exact, with as short a number as that allows; long lists are cut and say so.
std::string toText(const IndexSet& set);

}  // namespace lucarne
