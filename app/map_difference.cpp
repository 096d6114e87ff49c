#include "app/map_difference.h"

#include <cmath>

namespace lucarne {
namespace {

double square(double x) { return x * x; }

}  // namespace

MapDifference::MapDifference(const Dlm& a, const Dlm& b) : charts(a.maps.charts.size()) {
  if (a.maps.directionCount == b.maps.directionCount && a.maps.directionFilter == b.maps.directionFilter)
    directions.resize(static_cast<std::size_t>(a.maps.directionCount));
}

bool MapDifference::add(const MapSample& s) {
  ++samples;
  irradiance.add(s.area, s.a, s.b);
  charts[s.chart].add(s.area, s.a, s.b);
  const double la = luminance(s.a), lb = luminance(s.b);
  const double variance = square(s.errorA * la) + square(s.errorB * lb);
  if (variance > 0) {
    squares_ += s.area * square(lb - la);
    expected_ += s.area * variance;
  }
  const double difference = largestDifference(s.a, s.b);
  if (!(difference > largest_)) return false;
  largest_ = difference;
  worst.sample = s;
  return true;
}

std::optional<double> MapDifference::timesExpectedNoise() const {
  if (!(expected_ > 0)) return std::nullopt;
  return std::sqrt(squares_ / expected_);
}

}  // namespace lucarne
