#include "base/handover.h"

#include <stdexcept>
#include <thread>

namespace lucarne {

void Handover::serve(const std::function<void()>& produce) {
  std::exception_ptr producerFailure;
  std::thread producer([&] {
    try {
      produce();
    } catch (...) {
      producerFailure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    produced_ = true;
    changed_.notify_all();
  });
  for (;;) {
    Job* job = nullptr;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return produced_ || !waiting_.empty(); });
      if (waiting_.empty()) break;
      job = waiting_.front();
      waiting_.pop_front();
    }
    doJob(*job);
  }
  producer.join();
  if (failure_) std::rethrow_exception(failure_);
  if (producerFailure) std::rethrow_exception(producerFailure);
}

void Handover::doJob(Job& job) {
  std::exception_ptr failure;
  try {
    if (!failure_) (*job.work)();  // only this thread writes it
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  if (failure) failure_ = failure;
  job.done = true;
  changed_.notify_all();
}

void Handover::run(const std::function<void()>& work) {
  Job job{&work};
  std::unique_lock lock(mutex_);
  waiting_.push_back(&job);
  changed_.notify_all();
  changed_.wait(lock, [&] { return job.done; });
  if (failure_) throw std::runtime_error("the work was ended by an error");
}

}  // namespace lucarne
