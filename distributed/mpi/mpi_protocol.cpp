#include "distributed/mpi/mpi_protocol.h"

#include <chrono>
#include <thread>

#include "distributed/mpi/mpi_call.h"

namespace lucarne {
namespace {

constexpr int kReportTag = 1, kOrderTag = 2;

bool arrived(MPI_Comm comm, int source, int tag, MPI_Status& status) {
  int flag = 0;
  checkMpi(MPI_Iprobe(source, tag, comm, &flag, &status), "MPI_Iprobe");
  return flag != 0;
}

}  // namespace

void nap() { std::this_thread::sleep_for(std::chrono::microseconds(500)); }

RankOrder receiveOrder(MPI_Comm comm) {
  MPI_Status status;
  while (!arrived(comm, 0, kOrderTag, status)) nap();
  RankOrder order;
  checkMpi(MPI_Recv(&order, sizeof(order), MPI_BYTE, 0, kOrderTag, comm, MPI_STATUS_IGNORE), "MPI_Recv");
  return order;
}

void sendOrder(MPI_Comm comm, int rank, const RankOrder& order) {
  checkMpi(MPI_Send(&order, sizeof(order), MPI_BYTE, rank, kOrderTag, comm), "MPI_Send");
}

void sendReport(MPI_Comm comm, const RankReport& report) {
  checkMpi(MPI_Send(&report, sizeof(report), MPI_BYTE, 0, kReportTag, comm), "MPI_Send");
}

std::optional<ReceivedReport> takeReport(MPI_Comm comm) {
  MPI_Status status;
  if (!arrived(comm, MPI_ANY_SOURCE, kReportTag, status)) return std::nullopt;
  ReceivedReport received{status.MPI_SOURCE, {}};
  checkMpi(MPI_Recv(&received.report, sizeof(RankReport), MPI_BYTE, received.rank, kReportTag, comm, MPI_STATUS_IGNORE),
           "MPI_Recv");
  return received;
}

}  // namespace lucarne
