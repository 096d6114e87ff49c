#include "distributed/mpi/mpi_worker.h"

#include <chrono>

#include "distributed/mpi/mpi_protocol.h"
#include "distributed/mpi/mpi_sum.h"

namespace lucarne {
namespace {

RankReport traceRange(PhotonRun& run, IndexRange range, std::uint64_t& rays) {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t before = rays;
  run.trace(range, [&](const RunProgress& p) {
    rays = p.rays;
    return true;
  });
  return {range.size(), rays - before, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

RankReport gatherRange(DirectRun& run, IndexRange range) {
  const auto start = std::chrono::steady_clock::now();
  run.gather(range, [] { return true; });
  return {range.size(), 0, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace

void runWorker(MPI_Comm comm, const BakeJob& job, BakeState& state) {
  PhotonRun run(job.task, job.run, state.tallies);
  std::optional<DirectRun> direct;
  if (job.direct) direct.emplace(job.direct->gather, job.run.threads, state.tallies);
  RankReport report;
  std::uint64_t rays = 0;  // since the last collecting
  for (;;) {
    report.stop = job.control.stop() ? 1 : 0;
    sendReport(comm, report);
    report = {};
    const RankOrder order = receiveOrder(comm);
    if (order.order == Order::end) break;
    if (order.order == Order::trace) {
      report = traceRange(run, {order.begin, order.end}, rays);
      continue;
    }
    if (order.order == Order::gather) {
      report = gatherRange(direct.value(), {order.begin, order.end});
      continue;
    }
    run.collect(state.header.ledger);
    sumTallies(comm, state.tallies);
    sumLedgers(comm, state.header.ledger);
    if (direct) {
      DirectCounts counts;
      direct->collect(counts);
      sumCounts(comm, counts);
    }
    rays = 0;
  }
}

}  // namespace lucarne
