#include "player/cell_tables.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

/// Nodes along an edge: about 4° apart for few ψ, fewer for large sets, whose cells the horizon cuts in a thin band only.
int nodesFor(int directionCount) { return directionCount <= 128 ? 33 : directionCount <= 1024 ? 25 : 17; }

}  // namespace

LobeCell lobeCell(const DirectionSet& set, int psi, Vec3d n) {
  const ClippedCell cell = set.clippedCell(psi, n);
  const Vec3d direction = normalize(cell.moment);
  if (!(cell.cosIntegral > 0) || dot(direction, direction) == 0) return {Vec3f(set.direction(psi)), 0.f};
  return {Vec3f(direction), static_cast<float>(cell.cosIntegral)};
}

Vec3d octahedralNormal(Vec2d p) {
  Vec3d n{p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y)};
  if (n.z < 0) {
    n.x = (1 - std::abs(p.y)) * (p.x < 0 ? -1 : 1);
    n.y = (1 - std::abs(p.x)) * (p.y < 0 ? -1 : 1);
  }
  return normalize(n);
}

Vec2d octahedralPoint(Vec3d n) {
  const Vec2d p = Vec2d{n.x, n.y} * (1 / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)));
  if (n.z >= 0) return p;
  return {(1 - std::abs(p.y)) * (p.x < 0 ? -1 : 1), (1 - std::abs(p.x)) * (p.y < 0 ? -1 : 1)};
}

CellTable::CellTable(const DirectionSet& set, int maxLayers)
    : nodes_(nodesFor(set.count())),
      layers_(std::min(set.count(), maxLayers)),
      tiles_((set.count() + layers_ - 1) / layers_) {
  const auto width = static_cast<std::size_t>(nodes_ * tiles_), height = static_cast<std::size_t>(nodes_);
  texels_.resize(width * height * static_cast<std::size_t>(layers_));
  for (int y = 0; y < nodes_; ++y) {
    for (int x = 0; x < nodes_; ++x) {
      const double step = 2.0 / (nodes_ - 1);
      const Vec3d n = octahedralNormal({x * step - 1, y * step - 1});
      for (int psi = 0; psi < set.count(); ++psi) {
        const LobeCell cell = lobeCell(set, psi, n);
        const auto row = static_cast<std::size_t>((psi % layers_) * nodes_ + y);
        const auto column = static_cast<std::size_t>((psi / layers_) * nodes_ + x);
        texels_[row * width + column] = {cell.direction.x, cell.direction.y, cell.direction.z, cell.cosIntegral};
      }
    }
  }
}

LobeCell CellTable::lookUp(int psi, Vec3f n) const {
  const Vec2d p = octahedralPoint(Vec3d(n));
  const double half = 0.5 * (nodes_ - 1), x = (p.x + 1) * half, y = (p.y + 1) * half;
  const int x0 = std::clamp(static_cast<int>(x), 0, nodes_ - 2), y0 = std::clamp(static_cast<int>(y), 0, nodes_ - 2);
  LobeCell sum;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const auto w = static_cast<float>((dx ? x - x0 : 1 - x + x0) * (dy ? y - y0 : 1 - y + y0));
      const int row = (psi % layers_) * nodes_ + y0 + dy, column = (psi / layers_) * nodes_ + x0 + dx;
      const LobeTexel& t = texels_[static_cast<std::size_t>(row * nodes_ * tiles_ + column)];
      sum.direction += Vec3f{t.x, t.y, t.z} * w;
      sum.cosIntegral += t.c * w;
    }
  }
  return sum;
}

}  // namespace lucarne
