#include "distributed/range_dealer.h"

#include <algorithm>

namespace lucarne {

IndexRange RangeDealer::next(int rank) {
  const double rate = rates_[static_cast<std::size_t>(rank)];
  const std::uint64_t wanted = rate > 0 ? static_cast<std::uint64_t>(std::min(rate * kSeconds, 0x1p40)) : pieces_.first;
  const std::uint64_t share = left_.size() / (2 * rates_.size());
  const std::uint64_t size = std::min(left_.size(), std::max(pieces_.smallest, std::min(wanted, share)));
  const IndexRange piece{left_.begin, left_.begin + size};
  left_.begin += size;
  return piece;
}

void RangeDealer::finished(int rank, std::uint64_t indices, double seconds) {
  if (indices > 0 && seconds > 0) rates_[static_cast<std::size_t>(rank)] = static_cast<double>(indices) / seconds;
}

}  // namespace lucarne
