// What rank 0 and the others say to each other while tracing.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <optional>

namespace lucarne {

/// To rank 0: "I am free", and what was done since the last time.
struct RankReport {
  std::uint64_t count = 0, rays = 0;  // photons or samples
  double seconds = 0;
  std::uint64_t stop = 0;  // 1: this rank was told to stop, and so all are
};

enum class Order : std::uint64_t { gather, trace, collect, end };

/// From rank 0.
struct RankOrder {
  Order order = Order::end;
  std::uint64_t begin = 0, end = 0;
};

/// Waits without burning a core, as MPI's own waiting does: other ranks may trace on it.
RankOrder receiveOrder(MPI_Comm comm);
void sendOrder(MPI_Comm comm, int rank, const RankOrder& order);
void sendReport(MPI_Comm comm, const RankReport& report);

struct ReceivedReport {
  int rank;
  RankReport report;
};
/// The next report that has arrived, if any.
std::optional<ReceivedReport> takeReport(MPI_Comm comm);

/// For loops that wait.
void nap();

}  // namespace lucarne
