// Directional albedo of glass (glass.h), tabulated for one index: reflectance · reflected + totalInternal + tint ·
// transmitted.
//
// Features of the albedo are as wide as the lobe: about the critical angle, where its limit for smooth glass has a step
// and a root, and at grazing angles. So each row (one α) has its own nodes, dense about those places on the scale of α:
// at distance x from the anchor of a piece of length L, unit = (⁴√(1 + x/w) − 1) / (⁴√(1 + L/w) − 1), w the lobe's
// width. Rows are read at the units that belong to the α asked for, not at the same cosine, which keeps the step where
// it is between rows. Both ways cubics go through the nodes.
//
// Error against 48-point quadrature, indices 1.005 to 2.4, half of the questions about those features: root mean square
// below 3e-4, largest 9e-4; for one α alone below 5e-4. Building takes 0.1 to 0.15 s of processor time, shared by the
// threads, or 0.02 s for one α. At α = 1 a tenth to two thirds is lost between facets, as in every single-scattering
// model.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.h"

namespace lucarne {

class GlassTable {
 public:
  /// Shares of the light that goes on: after Fresnel reflection, total internal reflection and transmission.
  struct Albedo {
    float reflected = 0, totalInternal = 0, transmitted = 0;
    float sum() const { return reflected + totalInternal + transmitted; }
  };

  /// `ior` and `thin` of the glass; 0 stands for an infinite index. For every α from kMinAlpha to 1.
  GlassTable(float ior, bool thin);
  /// For one α: at() takes no other. Quicker to build, and finer.
  GlassTable(float ior, bool thin, float alpha);

  /// `inside`: from within the volume; a thin wall is the same from both sides.
  Albedo at(float cosTheta, float alpha, bool inside) const;

 private:
  /// One run of nodes of cosθ, dense at `anchor` (one of its ends) on the scale α·sine.
  struct Piece {
    float anchor, signedLength, sine;
    int firstNode, cells;
    float unit(float cosTheta, float alpha) const;
    float cosTheta(float unit, float alpha) const;
  };
  struct Side {
    float eta = 1;
    std::vector<Piece> pieces;  // by rising cosθ
    int rowNodes = 0;
    std::vector<Vec3f> nodes;  // [row][node]: (reflected, totalInternal, transmitted)
  };
  struct Row {
    std::size_t below;
    float part;
  };

  static constexpr int kRows = 32;
  void build(float ior, bool thin);
  void lay(Side& side) const;
  void fill(Side& side, bool thin) const;
  /// The rows about alpha, which is brought into range.
  Row locate(float& alpha) const;

  std::vector<float> alphas_;  // of the rows, rising
  int nodesPerRow_ = 0, quadrature_ = 0;
  Side sides_[2];  // from outside, from inside
  bool twoSided_ = false;
};

}  // namespace lucarne
