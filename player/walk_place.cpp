#include "player/walk_place.h"

#include <algorithm>
#include <cmath>

#include "player/walk_footing.h"

namespace lucarne {
namespace {

using namespace walk_body;

constexpr double kSmallestScene = 2.5;  // metres across
constexpr int kColumns = 1500, kGrid = 24, kMostLayers = 12;
constexpr double kNearestRing = 0.05;  // metres
constexpr double kOutOfSight = 4;      // so much farther counts a place behind a wall
constexpr double kBackSide = 4;        // or on a roof that is the back of a ceiling

/// The eye's place above the feet that is nearest to where it was.
double heightFor(double eyeAboveFeet) { return std::clamp(eyeAboveFeet + kEyeBelowTop, kCrouching, kStanding); }

class Search {
 public:
  Search(const WalkWorld& world, Vec3d eye) : world_(world), body_(world), eye_(eye) {}

  void look() {
    lookNear();
    if (!found_) lookEverywhere();
  }
  const std::optional<WalkerState>& found() const { return found_; }

 private:
  void lookNear() {
    const Box& box = world_.bounds();
    const Vec3d away{std::max(std::abs(eye_.x - box.lo.x), std::abs(eye_.x - box.hi.x)), 0,
                     std::max(std::abs(eye_.z - box.lo.z), std::abs(eye_.z - box.hi.z))};
    const double growth = std::log1p(length(away) / kNearestRing) / kColumns;
    for (int i = 0; i < kColumns; ++i) {  // a spiral, ever wider
      const double r = kNearestRing * std::expm1(growth * i), phi = 2.399963229728653 * i;
      if (r > best_) return;
      const double x = eye_.x + r * std::cos(phi), z = eye_.z + r * std::sin(phi);
      if (x < box.lo.x || x > box.hi.x || z < box.lo.z || z > box.hi.z) continue;
      lookDown({x, eye_.y, z});
      lookDown({x, box.hi.y + 1, z});
    }
  }
  /// A scene far off is a small part of a spiral.
  void lookEverywhere() {
    const Box& box = world_.bounds();
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        const double u = (i + 0.5) / kGrid, v = (j + 0.5) / kGrid;
        lookDown({box.lo.x + u * box.extent().x, box.hi.y + 1, box.lo.z + v * box.extent().z});
      }
    }
  }

  /// All floors of a column.
  void lookDown(Vec3d from) {
    for (int layer = 0; layer < kMostLayers; ++layer) {
      const auto met = world_.along(from, {0, -1, 0});
      if (!met) return;
      from.y -= met->distance;
      if (met->n.y >= 0.7) consider(from, met->front ? 1 : kBackSide);
      from.y -= std::max(0.01, 1e-6 * world_.frame().scale);
    }
  }

  void consider(Vec3d feet, double malus) {
    feet.y += 0.001;
    WalkerState state;
    state.feet = state.safe = feet;
    state.height = heightFor(eye_.y - feet.y);
    const double apart = length(state.eye() - eye_);
    if (apart >= best_) return;
    if (!body_.isFree(feet, state.height)) state.height = kCrouching;
    if (!body_.isFree(feet, state.height)) return;
    const Footing footing = footingAt(world_, feet);
    if (!footing.firm || !footing.floor || std::abs(*footing.floor - feet.y) > kStep) return;
    const double worth = malus * (isInSight(state.eye()) ? apart : kOutOfSight * apart);
    if (worth >= best_) return;
    best_ = worth;
    state.grounded = true;
    found_ = state;
  }

  bool isInSight(Vec3d place) const {
    const double way = length(place - eye_);
    return way < 1e-6 || !world_.along(eye_, (place - eye_) / way, way);
  }

  const WalkWorld& world_;
  WalkBody body_;
  Vec3d eye_;
  double best_ = 1e300;
  std::optional<WalkerState> found_;
};

}  // namespace

std::optional<WalkerState> nearestPlace(const WalkWorld& world, Vec3d eye) {
  if (world.bounds().empty() || length(world.bounds().extent()) < kSmallestScene || !isFinite(eye)) return {};
  Search search(world, eye);
  search.look();
  return search.found();
}

WalkerState placed(const WalkWorld& world, WalkerState state, Vec3d eye) {
  if (const auto found = nearestPlace(world, eye)) {
    WalkerState standing = *found;
    standing.yaw = state.yaw;
    standing.pitch = state.pitch;
    return standing;
  }
  state.flying = true;
  state.height = kStanding;
  state.upSpeed = 0;
  state.feet = eye - Vec3d{0, kStanding - kEyeBelowTop, 0};
  return state;
}

WalkerState startAt(const WalkWorld& world, const Camera& camera, bool flying) {
  WalkerState state;
  lookAlong(state, camera);
  const Vec3d eye = world.fromLocal(camera.position);
  if (!flying) return placed(world, state, eye);
  state.flying = true;
  state.feet = eye - Vec3d{0, kStanding - kEyeBelowTop, 0};
  return state;
}

}  // namespace lucarne
