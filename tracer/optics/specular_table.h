// Directional albedo of the GGX lobe, tabulated: ρ(cosθ) = F0·x + F90·y with (x, y) = scaleBias(cosθ, α).
#pragma once

#include <vector>

#include "base/vec.h"

namespace lucarne {

class SpecularTable {
 public:
  SpecularTable();

  /// (x, y): integrals of the lobe over the outgoing hemisphere, cosine included, for F = 1 − (1−v·h)⁵ and (1−v·h)⁵.
  Vec2f scaleBias(float cosTheta, float alpha) const;
  /// The same averaged over the hemisphere, 2∫ρ(μ)μ dμ.
  Vec2f meanScaleBias(float alpha) const;

  /// The one table of the program: built at the first call, immutable afterwards.
  static const SpecularTable& instance();

  static constexpr int kCosines = 128, kRoughnesses = 64;  // nodes: cosθ = i/(kCosines−1), √α = j/(kRoughnesses−1)
  static constexpr int kSize = kCosines;  // a fair resolution for copies of the table

 private:
  std::vector<Vec2f> directional_;  // [roughness][cos]
  std::vector<Vec2f> mean_;         // [roughness]
};

}  // namespace lucarne
