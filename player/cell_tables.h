// The cells of Ω above a horizon, as the shaders want them: for one exact normal, and for all normals as a table.
#pragma once

#include <vector>

#include "base/vec.h"
#include "dlm/direction_set.h"
#include "player/lobe.h"

namespace lucarne {

/// The cell, or tent, of ψ clipped by the horizon of unit normal `n`. Nothing left: ψ itself with C = 0.
LobeCell lobeCell(const DirectionSet& set, int psi, Vec3d n, Members members = Members::reaching);
/// The same with the mean direction of constant light in place of the unit direction: m̄ of lobe.h. Nothing left: ψ.
MeanCell meanCell(const DirectionSet& set, int psi, Vec3d n, Members members = Members::reaching);

enum class CellKind { direction, mean };

/// One texel of the table as uploaded.
struct LobeTexel {
  float x, y, z, c;
};

/// lobeCell(), or meanCell(), over an octahedral grid of normals, one square a ψ; nodes at texel centres, first and last on the edges
/// of the octahedral square, an odd count so that the six axes are nodes. With more ψ than layers the squares go on to
/// the right: ψ lies in layer ψ mod layers, tile ψ / layers. Tents are taken with all ψ for members: a chart of many
/// normals has more than those above one of its horizons.
class CellTable {
 public:
  CellTable(const DirectionSet& set, int maxLayers, CellKind kind = CellKind::direction);

  int nodes() const { return nodes_; }
  int layers() const { return layers_; }
  int tiles() const { return tiles_; }
  /// [layer][y][tile·nodes + x]
  const std::vector<LobeTexel>& texels() const { return texels_; }

  /// What the shader reads: bilinear at unit normal `n`. The direction is not normalised.
  LobeCell lookUp(int psi, Vec3f n) const;

 private:
  void fillNode(const DirectionSet& set, CellKind kind, int x, int y);
  std::size_t texelIndex(int psi, int x, int y) const;

  int nodes_ = 3, layers_ = 1, tiles_ = 1;
  std::vector<LobeTexel> texels_;
};

/// Octahedral square [−1, 1]² → unit normal, and back.
Vec3d octahedralNormal(Vec2d p);
Vec2d octahedralPoint(Vec3d n);

}  // namespace lucarne
