// What the walker's feet stand on: a few rays straight down.
#pragma once

#include <optional>

#include "player/walk_world.h"

namespace lucarne {

struct Footing {
  std::optional<double> floor;  // height of the highest floor under the feet, up to a step above them
  bool firm = false;            // floor all around, a step up or down at most: no edge near
  std::optional<double> slope;  // height of what is too steep to stand on, above any floor
  Vec3d downhill{};             // of the slope, unit, horizontal
  bool wall = false;            // the slope rises higher than a step: like a wall that faces downhill
};

/// Surfaces up to 45° are floor. The body above the feet must be free.
Footing footingAt(const WalkWorld& world, Vec3d feet);

}  // namespace lucarne
