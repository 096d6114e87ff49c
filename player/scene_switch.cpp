#include "player/scene_switch.h"

#include <utility>

#include "base/error.h"
#include "base/log.h"

namespace lucarne {
namespace {

constexpr double kLookInterval = 0.5, kWarmUpSeconds = 0.05;  // between looks at the folder; of a frame

double secondsSince(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

}  // namespace

SceneSwitch::SceneSwitch(Window& window, SceneRequest request, bool watch)
    : window_(window), request_(std::move(request)), isWatching_(watch), watch_(request_.dlm) {}

void SceneSwitch::begin(RendererKind renderer, const LookSettings& look) {
  request_.renderer = renderer;
  request_.view = look.view;
  request_.lobe = look.lobe;
  loader_ = std::make_unique<SceneLoader>(window_, request_);
  watch_.forget();
}

void SceneSwitch::step(RendererKind renderer, const LookSettings& look, bool first) {
  if (loader_ && loader_->isDone()) takeLoaded(first);
  if (loaded_) warmUp(renderer, look);
  if (!isWatching_ || isBusy() || secondsSince(lookedAt_) < kLookInterval) return;
  lookedAt_ = Clock::now();
  if (watch_.changed()) begin(renderer, look);
}

/// The first scene must load; a later one that does not leaves the one before.
void SceneSwitch::takeLoaded(bool first) {
  const std::unique_ptr<SceneLoader> loader = std::move(loader_);
  try {
    loaded_ = loader->take();
    state_ = State::cold;
    warmedUp_ = 0;
    failure_.clear();
  } catch (const Error& error) {
    if (first) throw;
    failure_ = std::string("not reloaded: ") + error.what();
    logWarning(failure_);
  }
}

void SceneSwitch::warmUp(RendererKind kind, const LookSettings& look) {
  const Clock::time_point start = Clock::now();
  FrameRenderer& renderer = loaded_->renderer;
  if (warmedUp_ == renderer.warmUpSteps()) {
    state_ = State::ready;
    return;
  }
  while (warmedUp_ < renderer.warmUpSteps() && secondsSince(start) < kWarmUpSeconds) {
    renderer.warmUp(kind, look.view, warmedUp_++);
    glFinish();
  }
  if (warmedUp_ == renderer.warmUpSteps()) state_ = State::warm;
}

std::unique_ptr<ShownScene> SceneSwitch::take() {
  if (state_ != State::ready) return nullptr;
  state_ = State::cold;
  return std::move(loaded_);
}

std::string SceneSwitch::progress() const {
  if (loader_) return loader_->progress();
  return loaded_ ? "compiling the shaders" : "";
}

}  // namespace lucarne
