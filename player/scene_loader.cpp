#include "player/scene_loader.h"

#include <cmath>
#include <utility>

#include "base/error.h"

namespace lucarne {

SceneLoader::SceneLoader(Window& window, SceneRequest request)
    : request_(std::move(request)), context_(window), thread_([this] { load(); }) {}

SceneLoader::~SceneLoader() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

void SceneLoader::load() {
  try {
    context_.makeCurrent(&messages_);
    scene_ = loadScene(request_, [this](const std::string& step, double share) { observe(step, share); });
    throwOnComplaint(messages_, "loading");
  } catch (...) {
    scene_.reset();
    failure_ = std::current_exception();
  }
  context_.release();
  done_ = true;
}

void SceneLoader::observe(const std::string& step, double share) {
  if (cancelled_) throw Error(ExitCode::interrupted, "the loading was ended");
  const std::lock_guard lock(mutex_);
  step_ = step;
  share_ = share;
}

std::string SceneLoader::progress() const {
  const std::lock_guard lock(mutex_);
  return step_ + "   " + std::to_string(std::lround(100 * share_)) + " %";
}

std::unique_ptr<ShownScene> SceneLoader::take() {
  thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  return std::move(scene_);
}

}  // namespace lucarne
