#include <cstdlib>
#include <string>

#include "distributed/mpi_job.h"

namespace lucarne {
namespace {

int numberIn(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text < '0' || *text > '9') return -1;
  return static_cast<int>(std::strtol(text, nullptr, 10));
}

}  // namespace

int launchedRank() {
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const int rank = numberIn(variable); rank >= 0) return rank;
  return -1;
}

#ifndef LUCARNE_HAS_MPI
std::unique_ptr<MpiJob> MpiJob::join() {
  if (launchedRank() < 0) return nullptr;
  throw Error(ExitCode::failed,
              "started by an MPI launcher, but this lucarne was built without MPI; build it where MPI is installed, or "
              "bake parts");
}
#endif

}  // namespace lucarne
