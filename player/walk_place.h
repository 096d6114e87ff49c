// Where a walker can stand.
#pragma once

#include <optional>

#include "player/walker.h"

namespace lucarne {

/// The free place with firm floor whose eye is nearest to `eye`, places in sight before those behind walls; none where
/// there is none, and in scenes that are too small for a person.
std::optional<WalkerState> nearestPlace(const WalkWorld& world, Vec3d eye);

/// `state` with its feet in nearestPlace(), or flying with its eye at `eye`. The eye stays where it is if it can.
WalkerState placed(const WalkWorld& world, WalkerState state, Vec3d eye);

/// At a camera: flying exactly there, or placed().
WalkerState startAt(const WalkWorld& world, const Camera& camera, bool flying);

}  // namespace lucarne
