#include "distributed/rate_curve.h"

#include <nlohmann/json.hpp>

namespace lucarne {
namespace {

/// Of points that reach so far: a quarter of a second, doubled until half of the points suffice.
std::uint64_t distanceOf(std::uint64_t milliseconds) {
  std::uint64_t distance = 250;
  while (milliseconds / distance > RateCurve::kMostPoints / 2) distance *= 2;
  return distance;
}

}  // namespace

void RateCurve::add(Point point) {
  if (!points_.empty() && (point.milliseconds < points_.back().milliseconds || point.photons < points_.back().photons))
    return;
  const std::size_t n = points_.size();
  const bool replaces =
      n >= 2 && points_[n - 1].milliseconds - points_[n - 2].milliseconds < distanceOf(point.milliseconds);
  if (replaces) points_.pop_back();
  points_.push_back(point);
  if (points_.size() <= kMostPoints) return;
  std::vector<Point> kept;
  for (const Point& p : points_) {
    const bool last = p == points_.back();
    if (kept.empty() || last || p.milliseconds - kept.back().milliseconds >= distanceOf(point.milliseconds))
      kept.push_back(p);
  }
  points_ = std::move(kept);
}

nlohmann::json RateCurve::toJson() const {
  nlohmann::json list = nlohmann::json::array();
  for (const Point& p : points_) list.push_back({p.milliseconds, p.photons});
  return list;
}

RateCurve RateCurve::from(const JsonView& list) {
  RateCurve curve;
  if (list.size() > kMostPoints) list.refuse("has too many points");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonView pair = list.at(i);
    if (pair.size() != 2) pair.refuse("must have 2 elements");
    const Point point{pair.at(0).count(), pair.at(1).count()};
    if (i > 0 &&
        (point.milliseconds < curve.points_.back().milliseconds || point.photons < curve.points_.back().photons))
      pair.refuse("must not be before the point before");
    curve.points_.push_back(point);
  }
  return curve;
}

}  // namespace lucarne
