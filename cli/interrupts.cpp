#include "cli/interrupts.h"

#include <pthread.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "base/error.h"
#include "base/log.h"
#include "distributed/mpi_job.h"

namespace lucarne {
namespace {

bool isIgnored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void ignore(int signal, struct sigaction& before) {
  struct sigaction action {};
  action.sa_handler = SIG_IGN;
  ::sigaction(signal, &action, &before);
}

/// One of several ranks tells it.
[[noreturn]] void leave(const std::string& line) {
  if (launchedRank() <= 0) logError(line);
  ::_exit(static_cast<int>(ExitCode::interrupted));
}

/// Some senders (timeout) send a signal to the process and to its group.
constexpr std::chrono::milliseconds kSameSignal(50);

}  // namespace

Interrupts::Interrupts(std::string stopping) : stopping_(std::move(stopping)) {
  sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU, SIGUSR1}) sigaddset(&watched_, signal);
  if (!isIgnored(SIGHUP)) sigaddset(&watched_, SIGHUP);
  ::pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  ignore(SIGPIPE, pipe_);
  ignore(SIGXFSZ, size_);
  thread_ = std::thread([this] { watch(); });
}

Interrupts::~Interrupts() {
  ended_ = true;
  ::pthread_kill(thread_.native_handle(), SIGUSR1);
  thread_.join();
  ::sigaction(SIGPIPE, &pipe_, nullptr);
  ::sigaction(SIGXFSZ, &size_, nullptr);
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interrupts::watch() {
  for (;;) {
    int signal = 0;
    ::sigwait(&watched_, &signal);
    if (ended_) return;
    if (signal == SIGUSR1) {
      preview_ = true;
    } else {
      stop();
    }
  }
}

void Interrupts::stop() {
  const std::lock_guard lock(mutex_);
  if (!line_.empty()) leave(line_);
  if (stop_) {
    if (Clock::now() - first_ < kSameSignal) return;
    leave("stopped at once; what was saved is whole");
  }
  first_ = Clock::now();
  stop_ = true;
  if (::isatty(STDERR_FILENO) == 1) std::fputs("\n", stderr);  // the live line stands there
  logInfo("stopping: " + stopping_ + "; a second signal ends at once");
}

JobControl Interrupts::control() {
  JobControl control;
  control.stop = [this] { return stop_.load(std::memory_order_relaxed); };
  control.takePreview = [this] { return preview_.exchange(false); };
  control.mayEndAtOnce = [this](const std::string& line) {
    const std::lock_guard lock(mutex_);
    line_ = line;
  };
  return control;
}

}  // namespace lucarne
