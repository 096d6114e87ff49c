// Rooms to walk in.
#pragma once

#include <cmath>

#include "player/walk_place.h"
#include "player/walk_world.h"
#include "player/walker.h"
#include "tests/support/scene_builder.h"

namespace lucarne::test {

/// Metres of the scene; the walker's own space starts at the scene's middle.
struct Walk {
  explicit Walk(const SceneBuilder& builder) : world(builder.build()), walker(world, {}) {}

  void standAt(Vec3d metres, double yaw = 0) {
    WalkerState s;
    s.feet = s.safe = metres - world.frame().origin;
    s.yaw = yaw;
    s.grounded = true;
    walker.set(s);
  }
  Vec3d feet() const { return walker.state().feet + world.frame().origin; }
  void hold(const WalkInput& input, double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds * kWalkTicks)); ++i) walker.tick(input, pace);
  }

  WalkWorld world;
  Walker walker;
  WalkPace pace;
};

inline WalkInput ahead(bool run = false) {
  WalkInput in;
  in.forward = 1;
  in.run = run;
  return in;
}

/// The yaw that looks along (x, z).
inline double yawTo(double x, double z) { return std::atan2(-x, -z); }

}  // namespace lucarne::test
