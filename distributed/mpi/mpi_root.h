// Rank 0: deals samples of direct light, then photons, to all ranks, itself among them, and brings the tallies together.
#pragma once

#include <mpi.h>

#include "distributed/bake_job.h"

namespace lucarne {

JobResult runRoot(MPI_Comm comm, const BakeJob& job, BakeState& state, CheckpointFolder* folder);

}  // namespace lucarne
