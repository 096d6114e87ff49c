#include "distributed/mpi/mpi_call.h"

#include <array>
#include <string>

#include "base/error.h"

namespace lucarne {

void checkMpi(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0, rank = -1;
  MPI_Error_string(code, text.data(), &length);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  throw Error(ExitCode::failed, std::string(call) + " failed on rank " + std::to_string(rank) + ": " +
                                    std::string(text.data(), static_cast<std::size_t>(length)));
}

}  // namespace lucarne
