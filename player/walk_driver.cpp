#include "player/walk_driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lucarne {
namespace {

constexpr double kLongestFrame = 0.5;  // seconds
constexpr double kRounding = 1e-6;     // of a tick: frames of whole ticks give all of them
constexpr double kRadian = 180 / std::numbers::pi;

}  // namespace

void WalkDriver::advance(double seconds, const WalkInput& input, const WalkPace& pace) {
  turnX_ += input.turnX;
  turnY_ += input.turnY;
  pending_ += std::clamp(seconds, 0.0, kLongestFrame);
  WalkInput held = input;
  const int ticks = static_cast<int>(std::floor(pending_ * kWalkTicks + kRounding));
  pending_ = std::max(pending_ - static_cast<double>(ticks) / kWalkTicks, 0.0);
  for (int i = 0; i < ticks; ++i) {
    held.turnX = std::exchange(turnX_, 0);
    held.turnY = std::exchange(turnY_, 0);
    before_ = walker_->state();
    walker_->tick(held, pace);
    note();
  }
}

void WalkDriver::set(const WalkerState& state) {
  walker_->set(state);
  before_ = state;
}

void WalkDriver::enter(const WalkWorld& world, const WalkerState& state) {
  world_ = &world;
  walker_ = std::make_unique<Walker>(world, state);
  before_ = state;
}

void WalkDriver::record() {
  recording_ = true;
  note();
}

std::vector<WalkPose> WalkDriver::takeRecording() {
  recording_ = false;
  return std::exchange(recorded_, {});
}

void WalkDriver::note() {
  if (!recording_ || recorded_.size() >= kMostPoses) return;
  const WalkerState& s = walker_->state();
  recorded_.push_back({world_->frame().origin + s.eye(), s.yaw * kRadian, s.pitch * kRadian});
}

}  // namespace lucarne
