// MPI calls whose failures say what failed, where and why.
#pragma once

#include <mpi.h>

namespace lucarne {

/// Throws Error(failed) "MPI_Reduce failed on rank 3: MPI's own text" unless the code is MPI_SUCCESS. Communicators
/// must return errors (MPI_ERRORS_RETURN) for this to be reached.
void checkMpi(int code, const char* call);

}  // namespace lucarne
