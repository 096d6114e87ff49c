#include "player/walk_footing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "player/walk_body.h"

namespace lucarne {
namespace {

using namespace walk_body;

constexpr int kRing = 8;
constexpr double kRingRadius = 0.6 * kRadius;  // metres: within the body, where the rays start
constexpr double kLevelCosine = 0.7;           // of 45°, and a little for rounding
constexpr double kSlack = 0.05, kBump = 0.02;  // metres

struct Foot {
  Vec3d place;  // where the ray met
  Vec3d n;
  bool level;
};

std::optional<Foot> footBelow(const WalkWorld& world, Vec3d from, double highest) {
  const auto met = world.along(from, {0, -1, 0});
  if (!met) return {};
  const Foot foot{from - Vec3d{0, met->distance, 0}, met->n, met->n.y >= kLevelCosine};
  if (foot.place.y > highest) return {};  // the body is held off it
  return foot;
}

/// Whether what rises too steeply at a foot ends below a step's height, like a cable or a rounded edge: just above that
/// height there is free way uphill, as far as a slope of 45° takes to rise there.
bool endsBelowStep(const WalkWorld& world, const Foot& foot, Vec3d feet, Vec3d uphill) {
  const Vec3d from{foot.place.x, feet.y + kStep + kBump, foot.place.z};
  return !world.along(from, uphill, kStep);
}

void standOn(Footing& footing, double height) {
  if (!footing.floor || height > *footing.floor) footing.floor = height;
}

void addSlope(Footing& footing, const WalkWorld& world, const Foot& foot, Vec3d feet) {
  const Vec3d downhill = normalize(Vec3d{foot.n.x, 0, foot.n.z});
  const double height = foot.place.y;
  if (height > feet.y + kBump && endsBelowStep(world, foot, feet, -downhill)) return standOn(footing, height);
  if (footing.slope && *footing.slope >= height) return;
  footing.slope = height;
  footing.downhill = downhill;
  footing.wall = height > feet.y + kBump;
}

}  // namespace

Footing footingAt(const WalkWorld& world, Vec3d feet) {
  std::array<std::optional<Foot>, kRing + 1> rays;
  int level = 0;
  Footing footing;
  for (int i = 0; i <= kRing; ++i) {
    const double angle = 0.78539816339744831 * i, r = i == kRing ? 0 : kRingRadius;
    const Vec3d from = feet + Vec3d{r * std::cos(angle), kStep + kRadius, r * std::sin(angle)};
    auto& foot = rays[static_cast<std::size_t>(i)];
    foot = footBelow(world, from, feet.y + kStep + kSlack);
    if (!foot || !foot->level) continue;
    standOn(footing, foot->place.y);
    level += foot->place.y >= feet.y - kStep ? 1 : 0;
  }
  footing.firm = level == kRing + 1;
  for (const auto& foot : rays) {
    if (foot && !foot->level && foot->place.y > footing.floor.value_or(-1e300) + kBump)
      addSlope(footing, world, *foot, feet);
  }
  return footing;
}

}  // namespace lucarne
