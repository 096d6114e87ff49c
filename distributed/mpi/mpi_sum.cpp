#include "distributed/mpi/mpi_sum.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "distributed/mpi/mpi_call.h"

namespace lucarne {
namespace {

// Numbers that are summed at a time: MPI counts in int, and needs buffers of its own.
constexpr std::size_t kBlock = std::size_t{1} << 22;

int rankOf(MPI_Comm comm) {
  int rank = 0;
  checkMpi(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
  return rank;
}

int sizeOf(MPI_Comm comm) {
  int size = 1;
  checkMpi(MPI_Comm_size(comm, &size), "MPI_Comm_size");
  return size;
}

/// A block cut into a share a rank, as equal as can be.
struct Shares {
  std::vector<int> counts, starts;

  Shares(std::size_t count, std::size_t ranks) {
    for (std::size_t r = 0; r <= ranks; ++r) starts.push_back(static_cast<int>(count * r / ranks));
    for (std::size_t r = 0; r < ranks; ++r) counts.push_back(starts[r + 1] - starts[r]);
  }
};

/// Every rank adds up its share of each block, and rank 0 gathers the shares: two transfers of the tallies whatever the
/// number of ranks, where a plain MPI_Reduce of large blocks takes log2 of it (docs/scaling.md).
void sumSpan(MPI_Comm comm, std::span<std::int64_t> values) {
  const auto rank = static_cast<std::size_t>(rankOf(comm));
  std::vector<std::int64_t> share;
  for (std::size_t at = 0; at < values.size(); at += kBlock) {
    const std::size_t count = std::min(kBlock, values.size() - at);
    const Shares shares(count, static_cast<std::size_t>(sizeOf(comm)));
    share.resize(static_cast<std::size_t>(shares.counts[rank]));
    std::int64_t* block = values.data() + at;
    checkMpi(MPI_Reduce_scatter(block, share.data(), shares.counts.data(), MPI_INT64_T, MPI_SUM, comm),
             "MPI_Reduce_scatter");
    checkMpi(MPI_Gatherv(share.data(), shares.counts[rank], MPI_INT64_T, block, shares.counts.data(),
                         shares.starts.data(), MPI_INT64_T, 0, comm),
             "MPI_Gatherv");
  }
}

}  // namespace

void sumTallies(MPI_Comm comm, Tallies& tallies) {
  sumSpan(comm, tallies.light());
  sumSpan(comm, tallies.statistics());
  sumSpan(comm, tallies.moments());
  if (tallies.direct() != nullptr) sumTallies(comm, *tallies.direct());
  if (rankOf(comm) != 0) tallies.clear();
}

void sumLedgers(MPI_Comm comm, Ledger& ledger) {
  static_assert(std::is_trivially_copyable_v<Ledger>);
  std::vector<Ledger> all(static_cast<std::size_t>(sizeOf(comm)));
  checkMpi(MPI_Gather(&ledger, sizeof(Ledger), MPI_BYTE, all.data(), sizeof(Ledger), MPI_BYTE, 0, comm), "MPI_Gather");
  if (rankOf(comm) == 0) {
    for (std::size_t i = 1; i < all.size(); ++i) ledger += all[i];
  } else {
    ledger = {};
  }
}

void sumCounts(MPI_Comm comm, DirectCounts& counts) {
  std::array<std::uint64_t, 3> all{counts.places, counts.clamped, counts.strayValues}, sum{};
  checkMpi(MPI_Reduce(all.data(), sum.data(), 3, MPI_UINT64_T, MPI_SUM, 0, comm), "MPI_Reduce");
  counts = {sum[0], sum[1], sum[2]};
}

}  // namespace lucarne
