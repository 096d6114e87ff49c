#include "player/walker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "player/walk_footing.h"
#include "player/walk_place.h"

namespace lucarne {
namespace {

using namespace walk_body;

constexpr double kTick = 1.0 / kWalkTicks;
constexpr double kRunFactor = 3, kCrouchFactor = 0.5;
constexpr double kSteepestLook = 0.49 * std::numbers::pi;
constexpr double kGravity = 9.81, kFastestFall = 0.85 * kRadius * kWalkTicks;  // m/s², m/s
constexpr double kJump = 3, kClimb = 2.5, kStretch = 2.5, kSkid = 2;           // m/s
constexpr double kLostBelow = 3;                                               // metres under all there is
constexpr int kMostParts = 64;                                                 // of the way of one tick

double least(double a, double b) { return a < b ? a : b; }

}  // namespace

WalkPace paceFor(const WalkWorld& world) {
  const double size = world.bounds().empty() ? 1 : std::max(length(world.bounds().extent()), 1e-6);
  return {1.5, std::clamp(1.5, 0.05 * size, 0.5 * size)};
}

void lookAlong(WalkerState& state, const Camera& camera) {
  state.yaw = std::atan2(camera.back.x, camera.back.z);
  state.pitch = std::clamp(-std::asin(std::clamp(camera.back.y, -1., 1.)), -kSteepestLook, kSteepestLook);
}

Camera cameraOf(const WalkWorld& world, const WalkerState& a, const WalkerState& b, double share, double yfov) {
  const double yaw = a.yaw + (b.yaw - a.yaw) * share, pitch = a.pitch + (b.pitch - a.pitch) * share;
  Camera c;
  c.position = world.toLocal(a.eye() + (b.eye() - a.eye()) * share);
  c.yfov = yfov;
  c.right = {std::cos(yaw), 0, -std::sin(yaw)};
  c.back = {std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
  c.up = cross(c.back, c.right);
  return c;
}

void Walker::turn(const WalkInput& input) {
  state_.yaw -= input.turnX;
  state_.pitch = std::clamp(state_.pitch - input.turnY, -kSteepestLook, kSteepestLook);
}

void Walker::fly(const WalkInput& input, double speed) {
  const double level = std::cos(state_.pitch);
  const Vec3d ahead{-std::sin(state_.yaw) * level, std::sin(state_.pitch), -std::cos(state_.yaw) * level};
  const Vec3d right{std::cos(state_.yaw), 0, -std::sin(state_.yaw)};
  const Vec3d way = ahead * input.forward + right * input.sideways + Vec3d{0, input.upward, 0};
  state_.feet += way * (speed * kTick / std::max(1.0, length(way)));  // slanting is no faster
  state_.upSpeed = 0;
  state_.grounded = false;
}

void Walker::tick(const WalkInput& input, const WalkPace& pace) {
  turn(input);
  const double hurry = input.run ? kRunFactor : 1;
  if (state_.flying) return fly(input, pace.fly * hurry);
  if (!body_.isFree(state_.feet, state_.height)) {
    state_ = placed(body_.world(), state_, state_.eye());
    if (state_.flying) return;
  }
  const Vec3d ahead{-std::sin(state_.yaw), 0, -std::cos(state_.yaw)};
  const Vec3d right{std::cos(state_.yaw), 0, -std::sin(state_.yaw)};
  const Vec3d way = ahead * input.forward + right * input.sideways;
  const bool low = state_.height < 0.5 * (kStanding + kCrouching);
  walk(way * (pace.walk * (low ? kCrouchFactor : hurry) * kTick / std::max(1.0, length(way))));

  if (input.upward > 0 && state_.grounded) state_.upSpeed = kJump;
  const Footing footing = footingAt(body_.world(), state_.feet);
  const double below = state_.grounded ? kStep : 0;
  if (state_.upSpeed <= 0 && footing.floor && *footing.floor >= state_.feet.y - below) {
    stand(*footing.floor);
    if (footing.firm) state_.safe = state_.feet;
  } else {
    fall(footing);
  }
  stretch(input.crouch);
}

/// What is left of a step where the ground ahead rises too steeply.
Vec3d Walker::heldBySlopes(Vec3d step) {
  const Footing ahead = footingAt(body_.world(), state_.feet + step);
  const double against = dot(step, ahead.downhill);
  return ahead.wall && against < 0 ? step - ahead.downhill * against : step;
}

void Walker::walk(Vec3d step) {
  const double way = length(step);
  if (!(way > 0)) return;
  const int parts = std::min(kMostParts, static_cast<int>(std::ceil(way / (0.4 * kRadius))));
  const double share = least(1.0 / parts, kMostMove / 2 / way);
  for (int i = 0; i < parts; ++i) {
    const auto to = body_.slide(state_.feet, state_.feet + step * share, state_.height);
    if (!to) return;
    const Vec3d held = heldBySlopes(*to - state_.feet);
    const auto place = held == *to - state_.feet ? to : body_.slide(state_.feet, state_.feet + held, state_.height);
    if (!place) return;
    state_.feet = *place;
    if (parts > 1) {  // a fast one climbs on the way
      const Footing footing = footingAt(body_.world(), state_.feet);
      if (state_.grounded && footing.floor && *footing.floor >= state_.feet.y - kStep) stand(*footing.floor);
    }
  }
}

/// Up or down by a bounded way, so that the eye glides over steps.
void Walker::stand(double floor) {
  rise(std::clamp(floor - state_.feet.y, -kClimb * kTick, kClimb * kTick));
  state_.upSpeed = 0;
  state_.grounded = true;
}

void Walker::fall(const Footing& footing) {
  state_.grounded = false;
  state_.upSpeed = std::max(state_.upSpeed - kGravity * kTick, -kFastestFall);
  const double ground = std::max(footing.floor.value_or(-1e300), footing.slope.value_or(-1e300));
  double by = state_.upSpeed * kTick;
  if (by < 0 && state_.feet.y + by < ground) by = least(0.0, ground - state_.feet.y);
  const bool free = rise(by);
  if (footing.slope && *footing.slope >= state_.feet.y - kStep / 4 && state_.upSpeed < 0) {  // skids down
    state_.upSpeed = std::max(state_.upSpeed, -kSkid);
    const auto to = body_.slide(state_.feet, state_.feet + footing.downhill * (kSkid * kTick), state_.height);
    if (to) state_.feet = *to;
  } else if (!free) {  // something beside the feet holds the body, or a ceiling stops a jump
    state_.grounded = state_.upSpeed < 0;
    state_.upSpeed = 0;
  }
  if (body_.world().bounds().lo.y - kLostBelow > state_.feet.y) comeBack();
}

void Walker::comeBack() {
  state_.feet = state_.safe;
  state_.upSpeed = 0;
  if (!footingAt(body_.world(), state_.feet).floor) state_ = placed(body_.world(), state_, state_.eye());
}

/// False where something is in the way that the body cannot be pushed aside from.
bool Walker::rise(double by) {
  const auto to = body_.slide(state_.feet, state_.feet + Vec3d{0, by, 0}, state_.height);
  if (to) state_.feet = *to;
  return to.has_value();
}

void Walker::stretch(bool crouch) {
  const double wanted = crouch ? kCrouching : kStanding;
  const double height = state_.height + std::clamp(wanted - state_.height, -kStretch * kTick, kStretch * kTick);
  if (height <= state_.height || body_.isFree(state_.feet, height)) state_.height = height;
}

}  // namespace lucarne
