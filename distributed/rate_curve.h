// How fast a bake went, from its beginning to its end: few points, however long the night.
#pragma once

#include <cstdint>
#include <vector>

#include "base/json.h"

namespace lucarne {

/// Photons done by a time. Both only grow. The clock counts the runs of one bake together: it stands still between a
/// kill and the run that goes on.
class RateCurve {
 public:
  struct Point {
    std::uint64_t milliseconds = 0, photons = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  static constexpr std::size_t kMostPoints = 400;

  /// The newest point always stands; earlier ones keep a distance that doubles whenever there would be too many.
  void add(Point point);
  const std::vector<Point>& points() const { return points_; }

  /// [[milliseconds, photons], …] and back; InputError for lists that add() does not make.
  nlohmann::json toJson() const;
  static RateCurve from(const JsonView& list);

 private:
  std::vector<Point> points_;
};

}  // namespace lucarne
