// From frames of any length to ticks of one length.
#pragma once

#include <memory>

#include "player/walk_path.h"
#include "player/walker.h"

namespace lucarne {

class WalkDriver {
 public:
  /// `world` must outlive it.
  WalkDriver(const WalkWorld& world, const WalkerState& start)
      : world_(&world), walker_(std::make_unique<Walker>(world, start)), before_(start) {}

  /// Lets that much time go by with `input` held. A tick too many or too few in one frame makes up for itself in the
  /// next; what is turned counts once, in the first tick to come. After a stall of more than half a second the walk
  /// goes on from where it was.
  void advance(double seconds, const WalkInput& input, const WalkPace& pace);

  /// Between the last two ticks, so that motion is as smooth as the frames.
  Camera camera(double yfov) const { return cameraOf(*world_, before_, walker_->state(), share(), yfov); }
  const WalkerState& state() const { return walker_->state(); }
  /// Puts the walker elsewhere at once.
  void set(const WalkerState& state);
  /// Puts the walker into another world, which must outlive it.
  void enter(const WalkWorld& world, const WalkerState& state);

  /// From now on every tick is noted, up to kMostPoses; the state that it starts in first.
  void record();
  bool recording() const { return recording_; }
  std::vector<WalkPose> takeRecording();

 private:
  double share() const { return pending_ * kWalkTicks; }
  void note();

  const WalkWorld* world_;
  std::unique_ptr<Walker> walker_;
  WalkerState before_;
  double pending_ = 0;  // seconds, less than a tick
  double turnX_ = 0, turnY_ = 0;
  bool recording_ = false;
  std::vector<WalkPose> recorded_;
};

}  // namespace lucarne
