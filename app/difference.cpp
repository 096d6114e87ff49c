#include "app/difference.h"

#include <cmath>

namespace lucarne {

void DifferenceSum::add(double weight, Rgbd a, Rgbd b) {
  const Rgbd d = b - a;
  weight_ += weight;
  squares_ += weight * dot(d, d) / 3;
  absolute_ += weight * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)) / 3;
  magnitude_ += weight * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z)) / 3;
  largest_ = std::max(largest_, largestDifference(a, b));
  a_ += a * weight;
  b_ += b * weight;
}

double DifferenceSum::rmse() const { return std::sqrt(squares_ / weight_); }
double DifferenceSum::relative() const { return absolute_ / magnitude_; }
double DifferenceSum::meanRatio() const { return luminance(b_) / luminance(a_); }

double largestDifference(Rgbd a, Rgbd b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

nlohmann::json finiteOrNull(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

nlohmann::json toJson(Vec3d v) { return {v.x, v.y, v.z}; }

nlohmann::json toJson(const DifferenceSum& sum, const std::string& unit) {
  if (sum.empty()) {
    return {{"rmse" + unit, nullptr},   {"relative_error", nullptr}, {"mean_a" + unit, nullptr},
            {"mean_b" + unit, nullptr}, {"mean_ratio", nullptr},     {"largest_difference" + unit, nullptr}};
  }
  return {{"rmse" + unit, finiteOrNull(sum.rmse())},     {"relative_error", finiteOrNull(sum.relative())},
          {"mean_a" + unit, toJson(sum.meanA())},        {"mean_b" + unit, toJson(sum.meanB())},
          {"mean_ratio", finiteOrNull(sum.meanRatio())}, {"largest_difference" + unit, finiteOrNull(sum.largest())}};
}

}  // namespace lucarne
