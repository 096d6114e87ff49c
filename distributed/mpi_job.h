// The ranks of an MPI job that bake together. Rank 0 reads, saves and writes; all trace.
//
// Present in every build: one without MPI has only join(), which finds nobody to bake with.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "distributed/bake_job.h"

namespace lucarne {

/// This process's rank, when an MPI launcher started it (mpirun, or srun with PMI); −1 when none did. Read from the
/// environment, so that programs start at once without MPI.
int launchedRank();

/// An error that all ranks know of and end with; rank 0 tells it.
class AgreedError : public Error {
 public:
  using Error::Error;
};

class MpiJob {
 public:
  virtual ~MpiJob() = default;
  MpiJob() = default;
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  /// Starts MPI when an MPI launcher started this process, else null. Error(failed) when it did and this program was
  /// built without MPI. MPI ends with the object.
  static std::unique_ptr<MpiJob> join();

  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Ranks on this machine.
  virtual int localSize() const = 0;

  /// All ranks must call these together.

  /// Runs `f` here. When it throws an Error on some ranks, all ranks throw that of the lowest of them as an
  /// AgreedError.
  virtual void agree(const std::function<void()>& f) = 0;
  /// Rank 0's bytes to all.
  virtual void broadcast(std::vector<std::uint8_t>& bytes) = 0;
  /// Every rank's text, in order, on all ranks.
  virtual std::vector<std::string> gather(const std::string& text) = 0;
  /// As runJob(). The state of rank 0 receives everything; those of the others are emptied. `folder` is used on rank 0
  /// alone, and the result is that of rank 0 alone. A rank that is told to stop stops all.
  virtual JobResult run(const BakeJob& job, BakeState& state, CheckpointFolder* folder) = 0;

  /// Tells the error and ends all ranks with its exit code: for errors that the others do not know of.
  [[noreturn]] virtual void fail(ExitCode code, const std::string& message) = 0;
};

}  // namespace lucarne
