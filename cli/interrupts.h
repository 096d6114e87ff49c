// Signals as requests to a running command.
#pragma once

#include <signal.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "distributed/job_control.h"

namespace lucarne {

/// While it lives:
///   SIGINT, SIGTERM, SIGXCPU, and SIGHUP where it is not ignored (nohup), ask the command to stop, which one line
///   tells: `stopping`; where nothing would be lost, or at the second of them, the process ends at once with 130;
///   SIGUSR1 asks for a preview;
///   SIGPIPE and SIGXFSZ are ignored: what cannot be written is an error like any other.
/// There are no handlers: the signals are blocked, and a thread waits for them. To be made before other threads are,
/// since they take over what is blocked.
class Interrupts {
 public:
  explicit Interrupts(std::string stopping = "the state is being saved");
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// Must not outlive this.
  JobControl control();

 private:
  using Clock = std::chrono::steady_clock;
  void watch();
  void stop();

  std::string stopping_;
  sigset_t watched_, before_;
  struct sigaction pipe_, size_;  // what was done about SIGPIPE and SIGXFSZ
  std::atomic<bool> stop_{false}, preview_{false}, ended_{false};
  std::mutex mutex_;
  std::string line_;  // not empty: the process may end at once, with this
  Clock::time_point first_;
  std::thread thread_;
};

}  // namespace lucarne
