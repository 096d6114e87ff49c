#include "distributed/mpi/mpi_sum.h"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "distributed/mpi/mpi_call.h"

namespace lucarne {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // numbers; MPI counts in int, and needs buffers of its own

int rankOf(MPI_Comm comm) {
  int rank = 0;
  checkMpi(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
  return rank;
}

void sumSpan(MPI_Comm comm, std::span<std::int64_t> values) {
  const bool root = rankOf(comm) == 0;
  for (std::size_t at = 0; at < values.size(); at += kBlock) {
    std::int64_t* block = values.data() + at;
    const int count = static_cast<int>(std::min(kBlock, values.size() - at));
    checkMpi(MPI_Reduce(root ? MPI_IN_PLACE : block, root ? block : nullptr, count, MPI_INT64_T, MPI_SUM, 0, comm), "MPI_Reduce");
  }
}

}  // namespace

void sumTallies(MPI_Comm comm, Tallies& tallies) {
  sumSpan(comm, tallies.light());
  sumSpan(comm, tallies.statistics());
  if (rankOf(comm) != 0) tallies.clear();
}

void sumLedgers(MPI_Comm comm, Ledger& ledger) {
  static_assert(std::is_trivially_copyable_v<Ledger>);
  int size = 1;
  checkMpi(MPI_Comm_size(comm, &size), "MPI_Comm_size");
  std::vector<Ledger> all(static_cast<std::size_t>(size));
  checkMpi(MPI_Gather(&ledger, sizeof(Ledger), MPI_BYTE, all.data(), sizeof(Ledger), MPI_BYTE, 0, comm), "MPI_Gather");
  if (rankOf(comm) == 0) {
    for (std::size_t i = 1; i < all.size(); ++i) ledger += all[i];
  } else {
    ledger = {};
  }
}

}  // namespace lucarne
