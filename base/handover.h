// Work that many threads make and only one may do, as with an OpenGL context.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>

namespace lucarne {

class Handover {
 public:
  /// Runs `produce` on a thread of its own and does here, until it returns, what it and its threads hand over. Throws on what
  /// either throws first; `produce` has always ended then.
  void serve(const std::function<void()>& produce);

  /// Returns when the thread that serves has done `work`. Throws where that has met an error before.
  void run(const std::function<void()>& work);

 private:
  struct Job {
    const std::function<void()>* work;
    bool done = false;
  };
  void doJob(Job& job);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job*> waiting_;
  bool produced_ = false;
  std::exception_ptr failure_;  // of work
};

}  // namespace lucarne
