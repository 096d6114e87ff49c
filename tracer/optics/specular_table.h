// Directional albedo of the GGX lobe, tabulated: ρ(cosθ) = F0·x + F90·y with (x, y) = scaleBias(cosθ, α).
#pragma once

#include <vector>

#include "base/vec.h"

namespace lucarne {

class SpecularTable {
 public:
  SpecularTable();

  /// The two rows of nodes about one roughness: for many directions at one α.
  class Row {
   public:
    Vec2f scaleBias(float cosTheta) const;
    Vec2f meanScaleBias() const { return mean_[0] * (1 - f_) + mean_[1] * f_; }

   private:
    friend class SpecularTable;
    const Vec2f *directional_, *mean_;
    float f_;
  };
  Row row(float alpha) const;

  /// (x, y): integrals of the lobe over the outgoing hemisphere, cosine included, for F = 1 − (1−v·h)⁵ and (1−v·h)⁵.
  Vec2f scaleBias(float cosTheta, float alpha) const { return row(alpha).scaleBias(cosTheta); }
  /// The same averaged over the hemisphere, 2∫ρ(μ)μ dμ.
  Vec2f meanScaleBias(float alpha) const { return row(alpha).meanScaleBias(); }

  /// The one table of the program: built at the first call, immutable afterwards.
  static const SpecularTable& instance();

  static constexpr int kCosines = 128, kRoughnesses = 64;  // nodes: cosθ = i/(kCosines−1), √α = j/(kRoughnesses−1)
  static constexpr int kSize = kCosines;                   // a fair resolution for copies of the table

 private:
  struct Cell {
    int i;
    float f;
  };
  static Cell locate(float unit, int nodes) {
    const float x = std::min(std::max(0.f, unit), 1.f) * static_cast<float>(nodes - 1);
    const int i = std::min(static_cast<int>(x), nodes - 2);
    return {i, x - static_cast<float>(i)};
  }

  std::vector<Vec2f> directional_;  // [roughness][cos]
  std::vector<Vec2f> mean_;         // [roughness]
};

inline Vec2f SpecularTable::Row::scaleBias(float cosTheta) const {
  const Cell c = locate(cosTheta, kCosines);
  const Vec2f* below = directional_ + c.i;
  const Vec2f* above = below + kCosines;
  const Vec2f a = below[0] * (1 - c.f) + below[1] * c.f;
  const Vec2f b = above[0] * (1 - c.f) + above[1] * c.f;
  return a * (1 - f_) + b * f_;
}

inline SpecularTable::Row SpecularTable::row(float alpha) const {
  const Cell r = locate(std::sqrt(alpha), kRoughnesses);
  Row row;
  row.directional_ = directional_.data() + r.i * kCosines;
  row.mean_ = mean_.data() + r.i;
  row.f_ = r.f;
  return row;
}

}  // namespace lucarne
