// Sums over samples (pixels, texels, points) of two fields, A the reference and B.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/vec.h"

namespace lucarne {

class DifferenceSum {
 public:
  /// `weight` is the area that the sample stands for.
  void add(double weight, Rgbd a, Rgbd b);

  bool empty() const { return weight_ == 0; }
  double weight() const { return weight_; }
  Rgbd meanA() const { return a_ / weight_; }
  Rgbd meanB() const { return b_ / weight_; }
  /// Over samples and channels.
  double rmse() const;
  /// Σ|B − A| / ΣA over samples and channels: of light maps, relative errors weighted by flux. NaN where A is black.
  double relative() const;
  /// Luminance of B over that of A; NaN where A is black.
  double meanRatio() const;
  /// max |B − A| over samples and channels.
  double largest() const { return largest_; }

 private:
  double weight_ = 0, squares_ = 0, absolute_ = 0, magnitude_ = 0, largest_ = 0;
  Rgbd a_{}, b_{};
};

/// max |B − A| over the channels.
double largestDifference(Rgbd a, Rgbd b);

/// rmse, relative_error, mean_a, mean_b, mean_ratio and largest_difference; `unit` ends the names of what has one
/// ("_lx"). What cannot be told (of black) is null.
nlohmann::json toJson(const DifferenceSum& sum, const std::string& unit);

nlohmann::json toJson(Vec3d v);
/// null for what is not finite.
nlohmann::json finiteOrNull(double value);

}  // namespace lucarne
