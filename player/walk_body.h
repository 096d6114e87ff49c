// The walker's body and how it keeps out of surfaces.
//
// The body is a vertical capsule that hovers a step's height above the feet, so that stairs, sills and thresholds pass
// below it; walk_footing.h finds what the feet stand on. A place is free when every surface is at least the capsule's
// radius away from its axis.
//
// No surface is ever crossed, however fast the walker and whatever the geometry: a body in a free place moves to a
// place that is free, too, and less than its radius away. The axis cannot have met a surface on the way, because the
// ball of that radius about each of its points was empty.
#pragma once

#include <optional>
#include <vector>

#include "player/walk_world.h"

namespace lucarne {

/// Metres.
namespace walk_body {
inline constexpr double kRadius = 0.25;  // through a door of 0.7 m with a hand's breadth to spare
inline constexpr double kStep = 0.35;
inline constexpr double kStanding = 1.75, kCrouching = 1.10;  // height; the eye is a little below
inline constexpr double kEyeBelowTop = 0.10;
inline constexpr double kMostMove = 0.9 * kRadius;  // at once
}  // namespace walk_body

class WalkBody {
 public:
  /// `world` must outlive it.
  explicit WalkBody(const WalkWorld& world) : world_(world) {}

  const WalkWorld& world() const { return world_; }
  bool isFree(Vec3d feet, double height);
  /// The free place to which a body that stands in a free place comes when it wants to go to `wanted`: there, or along
  /// what it meets. Pushed aside only, neither up nor down. None where it can go nowhere.
  std::optional<Vec3d> slide(Vec3d feet, Vec3d wanted, double height);

 private:
  struct Contact {
    Vec3d push;  // unit, from the surface to the axis
    double distance;
  };
  void look(Vec3d feet);
  Contact closest(Vec3d feet, double height) const;

  const WalkWorld& world_;
  // What is around; only saves asking the world again.
  std::vector<WalkTriangle> near_;
  std::optional<Vec3d> lookedFrom_;
};

}  // namespace lucarne
