// Loads a scene on a thread of its own, with a context that shares the window's objects, so that the window goes on.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

#include "player/shown_scene.h"
#include "player/window.h"

namespace lucarne {

class SceneLoader {
 public:
  /// Starts at once. To be made, asked and destroyed on the thread of the window, which must outlive it.
  SceneLoader(Window& window, SceneRequest request);
  /// Ends the loading at its next step and waits for that.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// "reading the maps   43 %".
  std::string progress() const;
  bool isDone() const { return done_; }
  /// Once, when it is done; throws what went wrong.
  std::unique_ptr<ShownScene> take();

 private:
  void load();
  void observe(const std::string& step, double share);

  SceneRequest request_;
  Window::SharedContext context_;
  std::atomic<bool> cancelled_{false}, done_{false};
  mutable std::mutex mutex_;
  std::string step_;
  double share_ = 0;
  std::unique_ptr<ShownScene> scene_;
  GlMessages messages_;  // of the shared context
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace lucarne
