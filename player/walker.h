// The walker: a fixed step of (state, input) → state, so that a walk is the same at any frame rate. No window in here.
#pragma once

#include "player/walk_body.h"
#include "player/walk_input.h"

namespace lucarne {

inline constexpr int kWalkTicks = 120;  // a second

/// Lengths in metres, places in walk space (walk_world.h).
struct WalkerState {
  Vec3d feet{};
  double yaw = 0, pitch = 0;  // radians; 0, 0 looks along −z, a positive pitch up
  double height = walk_body::kStanding;
  double upSpeed = 0;  // metres a second
  bool flying = false;
  bool grounded = false;
  Vec3d safe{};  // where the feet stood firmly last: one who falls out of the world comes back here

  Vec3d eye() const { return feet + Vec3d{0, height - walk_body::kEyeBelowTop, 0}; }
};

struct WalkPace {
  double walk = 1.5, fly = 1.5;  // metres a second; thrice that when running
};

/// A person's pace; flying also crosses scenes of any size in a reasonable time.
WalkPace paceFor(const WalkWorld& world);

/// The looks of a camera, upright: its roll is lost.
void lookAlong(WalkerState& state, const Camera& camera);
/// What the walker sees, in the scene's local units; between two states: share 0 … 1 of the way from a to b.
Camera cameraOf(const WalkWorld& world, const WalkerState& a, const WalkerState& b, double share, double yfov);

struct Footing;  // walk_footing.h

class Walker {
 public:
  /// `world` must outlive it.
  Walker(const WalkWorld& world, const WalkerState& start) : body_(world), state_(start) {}

  const WalkerState& state() const { return state_; }
  void set(const WalkerState& state) { state_ = state; }
  /// One tick. Turning is never hindered. A walker whose place is not free, or is no more, is put in the nearest that
  /// is; where there is none it flies.
  void tick(const WalkInput& input, const WalkPace& pace);

 private:
  void turn(const WalkInput& input);
  void fly(const WalkInput& input, double speed);
  void walk(Vec3d step);
  Vec3d heldBySlopes(Vec3d step);
  void stand(double floor);
  void fall(const Footing& footing);
  bool rise(double by);
  void comeBack();
  void stretch(bool crouch);

  WalkBody body_;
  WalkerState state_;
};

}  // namespace lucarne
