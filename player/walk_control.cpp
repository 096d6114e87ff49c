#include "player/walk_control.h"

#include <algorithm>
#include <numbers>

#include "base/units.h"
#include "player/walk_place.h"

namespace lucarne {
namespace {

constexpr double kPacePerNotch = 1.25, kSlowestPace = 1. / 16, kFastestPace = 64;
constexpr double kWalkedWithin = 0.3;  // metres between the eye of a walker and that of a path
constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace

WalkControl::WalkControl(std::shared_ptr<const WalkScene> scene, bool flying)
    : scene_(std::move(scene)),
      camera_(scene_->start),
      driver_(scene_->world, startAt(scene_->world, camera_, flying)) {}

void WalkControl::press(WalkKey key) {
  switch (key) {
    case WalkKey::fly:
      return changeFlying();
    case WalkKey::nextCamera:
      return changeCamera(1);
    case WalkKey::previousCamera:
      return changeCamera(-1);
    case WalkKey::startAgain:
      return changeCamera(0);
    case WalkKey::faster:
      pace_ = std::min(pace_ * kPacePerNotch, kFastestPace);
      return;
    case WalkKey::slower:
      pace_ = std::max(pace_ / kPacePerNotch, kSlowestPace);
      return;
    default:
      return;
  }
}

void WalkControl::changeFlying() {
  leavePath();
  WalkerState state = driver_.state();
  state.flying = !state.flying;
  driver_.set(state.flying ? state : placed(scene_->world, state, state.eye()));
}

/// To the next camera of the file, the one before, or (0) to the last one gone to.
void WalkControl::changeCamera(int by) {
  path_.reset();
  const auto count = static_cast<int>(scene_->cameras.size());
  if (by != 0 && count > 0) {
    cameraIndex_ = cameraIndex_ < 0 ? (by > 0 ? 0 : count - 1) : (cameraIndex_ + by + count) % count;
    camera_ = scene_->cameras[static_cast<std::size_t>(cameraIndex_)];
  }
  driver_.set(startAt(scene_->world, camera_, driver_.state().flying));
}

void WalkControl::advance(double seconds, const WalkInput& input) {
  if (path_) {
    pathSeconds_ += seconds;
    if (pathSeconds_ > path_->seconds() || input.moving()) leavePath();
  }
  const WalkPace usual = paceFor(scene_->world);
  if (!path_) driver_.advance(seconds, input, {usual.walk * pace_, usual.fly * pace_});
}

Camera WalkControl::camera() const {
  if (!path_) return driver_.camera(camera_.yfov);
  return cameraOf(path_->at(pathSeconds_), path_->yfov, scene_->world.frame());
}

std::string WalkControl::startNote() const {
  if (!flying()) return {};
  if (scene_->world.bounds().empty()) return "nothing to stand on: flying";
  const double metres = length(scene_->world.bounds().extent());
  return "no place to stand near the camera (the scene is " + formatNumber(metres) + " m across): flying";
}

void WalkControl::replay(WalkPath path) {
  path_ = std::move(path);
  pathSeconds_ = 0;
}

/// The walker goes on from where the path is: on foot, or flying where the path was not walked.
void WalkControl::leavePath() {
  if (!path_) return;
  const Camera camera = this->camera();
  camera_ = camera;
  path_.reset();
  WalkerState state = startAt(scene_->world, camera, driver_.state().flying);
  if (length(state.eye() - scene_->world.fromLocal(camera.position)) > kWalkedWithin)
    state = startAt(scene_->world, camera, true);
  driver_.set(state);
}

WalkPath WalkControl::takeRecording() { return {kWalkTicks, camera_.yfov * kDegrees, driver_.takeRecording()}; }

void WalkControl::moveTo(std::shared_ptr<const WalkScene> scene) {
  const LocalFrame &from = scene_->world.frame(), &to = scene->world.frame();
  WalkerState state = driver_.state();
  state.feet += from.origin - to.origin;
  state.safe += from.origin - to.origin;
  camera_.position = to.toLocal(from.toWorld(camera_.position));
  if (!state.flying && !scene->world.along(state.eye(), {0, -1, 0})) state = placed(scene->world, state, state.eye());
  driver_.enter(scene->world, state);
  scene_ = std::move(scene);
  cameraIndex_ = -1;
}

}  // namespace lucarne
