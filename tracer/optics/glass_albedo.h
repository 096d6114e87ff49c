// Directional albedo of glass (glass.h) by quadrature: where glass_table.h takes its nodes from.
#pragma once

#include <vector>

#include "base/vec.h"

namespace lucarne {

/// Gauss and Legendre's rule on [0, 1].
struct GaussRule {
  explicit GaussRule(int n);
  std::vector<float> x, weight;
};

/// Shares (reflected, totalInternal, transmitted) of the light from cosTheta > 0 that goes on (GlassTable::Albedo).
/// `eta`, `thin` and `alpha` as in Glass. With 16 points within
/// 6e-4 and mostly 1e-4, against 96: what is left is the bend where reflection passes the horizon.
Vec3f glassShares(float eta, bool thin, float alpha, float cosTheta, const GaussRule& rule);

}  // namespace lucarne
