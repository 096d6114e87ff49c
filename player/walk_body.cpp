#include "player/walk_body.h"

#include <algorithm>
#include <cmath>

#include "player/segment_triangle.h"

namespace lucarne {
namespace {

using namespace walk_body;

constexpr double kTolerance = 0.001;  // metres: that much nearer than the radius is still free
constexpr double kReach = 1.3;        // from the middle of the body, to all that it can touch after kLookAgain
constexpr double kLookAgain = 0.3;    // metres
constexpr double kMiddle = 1.05;      // of the axis, above the feet
constexpr int kMostPushes = 12;
constexpr double kSideways = 0.1;  // the least horizontal part of a direction in which pushing aside helps

bool isFarFrom(const WalkTriangle& t, Vec3d low, Vec3d high) {
  return t.hi.x < low.x - kRadius || t.lo.x > low.x + kRadius || t.hi.z < low.z - kRadius || t.lo.z > low.z + kRadius ||
         t.hi.y < low.y - kRadius || t.lo.y > high.y + kRadius;
}

}  // namespace

void WalkBody::look(Vec3d feet) {
  if (lookedFrom_ && length(feet - *lookedFrom_) < kLookAgain) return;
  near_ = world_.around(feet + Vec3d{0, kMiddle, 0}, kReach);
  lookedFrom_ = feet;
}

WalkBody::Contact WalkBody::closest(Vec3d feet, double height) const {
  const Vec3d low = feet + Vec3d{0, kStep + kRadius, 0}, high = feet + Vec3d{0, height - kRadius, 0};
  NearestPair best;
  for (const WalkTriangle& t : near_) {
    if (isFarFrom(t, low, high)) continue;
    const NearestPair pair = nearestPair(low, high, t.corner);
    if (pair.squaredDistance < best.squaredDistance) best = pair;
  }
  return {normalize(best.onSegment - best.onTriangle), std::sqrt(best.squaredDistance)};
}

bool WalkBody::isFree(Vec3d feet, double height) {
  look(feet);
  return closest(feet, height).distance >= kRadius - kTolerance;
}

std::optional<Vec3d> WalkBody::slide(Vec3d feet, Vec3d wanted, double height) {
  look(wanted);
  Vec3d place = wanted;
  for (int i = 0; i < kMostPushes; ++i) {
    const Contact contact = closest(place, height);
    if (contact.distance >= kRadius - kTolerance / 2) break;
    const Vec3d aside{contact.push.x, 0, contact.push.z};
    const double share = length(aside);
    if (share < kSideways) return {};
    place += aside * ((kRadius - contact.distance) / (share * share));
    if (length(place - feet) > kMostMove) return {};
  }
  if (length(place - feet) > kMostMove || closest(place, height).distance < kRadius - kTolerance) return {};
  return place;
}

}  // namespace lucarne
