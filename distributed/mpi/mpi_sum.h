// Sums over ranks, exact in any order.
#pragma once

#include <mpi.h>

#include "distributed/bake_job.h"

namespace lucarne {

/// Adds the tallies of all ranks into those of rank 0, in blocks, and empties the others'. Collective.
void sumTallies(MPI_Comm comm, Tallies& tallies);
/// The same for what was counted beside them.
void sumLedgers(MPI_Comm comm, Ledger& ledger);
void sumCounts(MPI_Comm comm, DirectCounts& counts);

}  // namespace lucarne
