// A rank other than 0: asks for photons until there are no more.
#pragma once

#include <mpi.h>

#include "distributed/bake_job.h"

namespace lucarne {

void runWorker(MPI_Comm comm, const BakeJob& job, BakeState& state);

}  // namespace lucarne
