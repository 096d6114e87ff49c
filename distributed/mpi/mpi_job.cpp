#include "distributed/mpi_job.h"

#include <mpi.h>

#include <cstdio>

#include "distributed/mpi/mpi_call.h"
#include "distributed/mpi/mpi_root.h"
#include "distributed/mpi/mpi_worker.h"

namespace lucarne {
namespace {

/// MPI from its start to its end.
class Session {
 public:
  Session() {
    int provided = 0;
    checkMpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
    if (provided < MPI_THREAD_FUNNELED)
      throw Error(ExitCode::failed, "this MPI allows no threads beside its own; use another");
    checkMpi(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  }
  ~Session() { MPI_Finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

class MpiJobImpl final : public MpiJob {
 public:
  MpiJobImpl() {
    checkMpi(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
    checkMpi(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
    MPI_Comm local;
    checkMpi(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &local), "MPI_Comm_split_type");
    checkMpi(MPI_Comm_size(local, &localSize_), "MPI_Comm_size");
    checkMpi(MPI_Comm_free(&local), "MPI_Comm_free");
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int localSize() const override { return localSize_; }

  void agree(const std::function<void()>& f) override {
    std::string message;
    int code = 0;
    try {
      f();
    } catch (const Error& error) {
      message = error.what();
      code = static_cast<int>(error.code());
    }
    int mine = code == 0 ? size_ : rank_, first = size_;
    checkMpi(MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm_), "MPI_Allreduce");
    if (first == size_) return;
    checkMpi(MPI_Bcast(&code, 1, MPI_INT, first, comm_), "MPI_Bcast");
    std::vector<std::uint8_t> text(message.begin(), message.end());
    broadcastFrom(first, text);
    const std::string where = first == 0 ? "" : "rank " + std::to_string(first) + ": ";
    throw AgreedError(static_cast<ExitCode>(code), where + std::string(text.begin(), text.end()));
  }

  void broadcast(std::vector<std::uint8_t>& bytes) override { broadcastFrom(0, bytes); }

  std::vector<std::string> gather(const std::string& text) override {
    std::vector<std::string> all;
    for (int rank = 0; rank < size_; ++rank) {
      std::vector<std::uint8_t> bytes(text.begin(), text.end());
      broadcastFrom(rank, bytes);
      all.emplace_back(bytes.begin(), bytes.end());
    }
    return all;
  }

  JobResult run(const BakeJob& job, BakeState& state, CheckpointFolder* folder) override {
    if (rank_ == 0) return runRoot(comm_, job, state, folder);
    runWorker(comm_, job, state);
    return {};
  }

  void fail(ExitCode code, const std::string& message) override {
    std::fprintf(stderr, "lucarne: rank %d: %s\n", rank_, message.c_str());
    std::fflush(stderr);
    MPI_Abort(comm_, static_cast<int>(code));
    std::abort();  // MPI_Abort does not come back
  }

 private:
  void broadcastFrom(int root, std::vector<std::uint8_t>& bytes) {
    std::uint64_t size = bytes.size();
    checkMpi(MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm_), "MPI_Bcast");
    bytes.resize(size);
    constexpr std::uint64_t kBlock = std::uint64_t{1} << 30;  // MPI counts in int
    for (std::uint64_t at = 0; at < size; at += kBlock)
      checkMpi(MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(kBlock, size - at)), MPI_BYTE, root, comm_),
               "MPI_Bcast");
  }

  Session session_;
  MPI_Comm comm_ = MPI_COMM_WORLD;
  int rank_ = 0, size_ = 1, localSize_ = 1;
};

}  // namespace

std::unique_ptr<MpiJob> MpiJob::join() {
  if (launchedRank() < 0) return nullptr;
  return std::make_unique<MpiJobImpl>();
}

}  // namespace lucarne
