#include "player/cell_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

/// Nodes along an edge. About 2.5° apart constant light comes out within 2 % for the sharpest lobes and grazing views;
/// at 5° it errs by up to 5 % there (|Ω| = 256). Larger sets must do with less, for the time and the memory.
int nodesFor(int directionCount) { return directionCount <= 256 ? 65 : directionCount <= 1024 ? 33 : 17; }

}  // namespace

LobeCell lobeCell(const DirectionSet& set, int psi, Vec3d n, Members members) {
  const ClippedCell cell = set.clippedCell(psi, n, members);
  const Vec3d direction = normalize(cell.moment);
  if (!(cell.cosIntegral > 0) || dot(direction, direction) == 0) return {Vec3f(set.direction(psi)), 0.f};
  return {Vec3f(direction), static_cast<float>(cell.cosIntegral)};
}

MeanCell meanCell(const DirectionSet& set, int psi, Vec3d n, Members members) {
  constexpr double kLeast = 1e-12;  // sr
  const LobeCell cell = lobeCell(set, psi, n, members);
  if (!(static_cast<double>(cell.cosIntegral) > kLeast)) return cell;
  return {Vec3f(set.cosineMoment(psi, n, members) / static_cast<double>(cell.cosIntegral)), cell.cosIntegral};
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

CellTable::CellTable(const DirectionSet& set, int maxLayers, CellKind kind)
    : nodes_(nodesFor(set.count())),
      layers_(std::min(set.count(), maxLayers)),
      tiles_((set.count() + layers_ - 1) / layers_) {
  const auto width = static_cast<std::size_t>(nodes_ * tiles_), height = static_cast<std::size_t>(nodes_);
  texels_.resize(width * height * static_cast<std::size_t>(layers_));
  tbb::parallel_for(0, nodes_, [&](int y) {
    for (int x = 0; x < nodes_; ++x) fillNode(set, kind, x, y);
  });
}

void CellTable::fillNode(const DirectionSet& set, CellKind kind, int x, int y) {
  const double step = 2.0 / (nodes_ - 1);
  const Vec3d n = octahedralNormal({x * step - 1, y * step - 1});
  for (int psi = 0; psi < set.count(); ++psi) {
    const LobeCell cell = kind == CellKind::mean ? meanCell(set, psi, n, Members::all) : lobeCell(set, psi, n, Members::all);
    texels_[texelIndex(psi, x, y)] = {cell.direction.x, cell.direction.y, cell.direction.z, cell.cosIntegral};
  }
}

std::size_t CellTable::texelIndex(int psi, int x, int y) const {
  const int row = (psi % layers_) * nodes_ + y, column = (psi / layers_) * nodes_ + x;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(nodes_ * tiles_) + static_cast<std::size_t>(column);
}

LobeCell CellTable::lookUp(int psi, Vec3f n) const {
  const Vec2d p = octahedralPoint(Vec3d(n));
  const double half = 0.5 * (nodes_ - 1), x = (p.x + 1) * half, y = (p.y + 1) * half;
  const int x0 = std::clamp(static_cast<int>(x), 0, nodes_ - 2), y0 = std::clamp(static_cast<int>(y), 0, nodes_ - 2);
  LobeCell sum;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const auto w = static_cast<float>((dx ? x - x0 : 1 - x + x0) * (dy ? y - y0 : 1 - y + y0));
      const LobeTexel& t = texels_[texelIndex(psi, x0 + dx, y0 + dy)];
      sum.direction += Vec3f{t.x, t.y, t.z} * w;
      sum.cosIntegral += t.c * w;
    }
  }
  return sum;
}

}  // namespace lucarne
