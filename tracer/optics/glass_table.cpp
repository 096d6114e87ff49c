#include "tracer/optics/glass_table.h"

#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "tracer/optics/dielectric.h"
#include "tracer/optics/ggx.h"
#include "tracer/optics/glass_albedo.h"

namespace lucarne {
namespace {

float fourthRoot(float x) { return std::sqrt(std::sqrt(x)); }

constexpr float kFirstRoot = 0.42f;  // of the first row, α = 0.00097

/// Catmull and Rom's cubic through nodes[1] and nodes[2].
struct CubicWeights {
  float w[4];
  explicit CubicWeights(float f) {
    const float f2 = f * f, f3 = f2 * f;
    w[0] = 0.5f * (2 * f2 - f - f3);
    w[1] = 0.5f * (2 - 5 * f2 + 3 * f3);
    w[2] = 0.5f * (f + 4 * f2 - 3 * f3);
    w[3] = 0.5f * (f3 - f2);
  }
  Vec3f of(const Vec3f* nodes) const { return nodes[0] * w[0] + nodes[1] * w[1] + nodes[2] * w[2] + nodes[3] * w[3]; }
};

}  // namespace

float GlassTable::Piece::unit(float cosTheta, float alpha) const {
  const float x = std::max(signedLength > 0 ? cosTheta - anchor : anchor - cosTheta, 0.f), width = 0.25f * alpha * sine;
  return (fourthRoot(1.f + x / width) - 1.f) / (fourthRoot(1.f + std::abs(signedLength) / width) - 1.f);
}

float GlassTable::Piece::cosTheta(float unit, float alpha) const {
  const float width = 0.25f * alpha * sine;
  const float r = 1.f + unit * (fourthRoot(1.f + std::abs(signedLength) / width) - 1.f);
  const float x = width * (r * r * r * r - 1.f);
  return signedLength > 0 ? anchor + x : anchor - x;
}

GlassTable::GlassTable(float ior, bool thin) : nodesPerRow_(128), quadrature_(thin ? 24 : 16) {
  for (int j = 0; j <= kRows; ++j) {
    const float root = kFirstRoot + (1.f - kFirstRoot) * static_cast<float>(j) / kRows;
    alphas_.push_back(root * root * (root * root) * (root * root) * (root * root));
  }
  build(ior, thin);
}

GlassTable::GlassTable(float ior, bool thin, float alpha) : nodesPerRow_(240), quadrature_(24) {
  alphas_ = {std::max(alpha, kMinAlpha)};
  build(ior, thin);
}

void GlassTable::build(float ior, bool thin) {
  if (!thin && isStraight(ior)) {  // see limit() in glass.cpp
    thin = true;
    ior = 1;
    alphas_ = {kMinAlpha};
  }
  twoSided_ = !thin;
  for (int s = 0; s < (twoSided_ ? 2 : 1); ++s) {
    sides_[s].eta = s == 0 ? ior : 1.f / ior;
    lay(sides_[s]);
    fill(sides_[s], thin);
  }
}

/// Without a critical angle one piece from grazing upwards; else two that meet half way below it, and one above.
void GlassTable::lay(Side& side) const {
  const float eta = side.eta;
  const auto cells = [&](double share) { return static_cast<int>(share * nodesPerRow_); };
  if (reflectsAll(eta) || eta >= 1) {
    side.pieces = {{0, 1, 1, 0, cells(1)}};
  } else {
    const float critical = std::sqrt((1.f - eta) * (1.f + eta));
    side.pieces = {{0, 0.5f * critical, 1, 0, cells(0.25)},
                   {critical, -0.5f * critical, eta, 0, cells(0.3)},
                   {critical, 1.f - critical, eta, 0, cells(0.45)}};
  }
  side.rowNodes = 0;
  for (Piece& piece : side.pieces) {
    piece.firstNode = side.rowNodes;
    side.rowNodes += piece.cells + 3;
  }
}

/// Each run of nodes has one more at either end, on the parabola through the last three.
void GlassTable::fill(Side& side, bool thin) const {
  const GaussRule rule(quadrature_);
  side.nodes.resize(alphas_.size() * static_cast<std::size_t>(side.rowNodes));
  tbb::parallel_for(std::size_t{0}, alphas_.size() * side.pieces.size(), [&](std::size_t task) {
    const std::size_t row = task / side.pieces.size();
    const Piece& piece = side.pieces[task % side.pieces.size()];
    Vec3f* const nodes = side.nodes.data() + row * static_cast<std::size_t>(side.rowNodes) + piece.firstNode;
    for (int i = 0; i <= piece.cells; ++i) {
      const float mu = piece.cosTheta(static_cast<float>(i) / static_cast<float>(piece.cells), alphas_[row]);
      nodes[i + 1] = glassShares(side.eta, thin, alphas_[row], mu, rule);
    }
    const int n = piece.cells;
    nodes[0] = (nodes[1] - nodes[2]) * 3.f + nodes[3];
    nodes[n + 2] = (nodes[n + 1] - nodes[n]) * 3.f + nodes[n - 1];
  });
}

/// Rows are even in the eighth root of α. The first and the last three share a parabola's end, as runs of nodes do.
GlassTable::Row GlassTable::locate(float& alpha) const {
  if (alphas_.size() == 1) {
    alpha = alphas_[0];
    return {0, 0};
  }
  alpha = std::clamp(alpha, alphas_.front(), 1.f);
  const float x = (std::sqrt(fourthRoot(alpha)) - kFirstRoot) * (kRows / (1.f - kFirstRoot));
  const std::size_t below = std::min(static_cast<std::size_t>(std::max(x, 0.f)), alphas_.size() - 2);
  return {below, x - static_cast<float>(below)};
}

GlassTable::Albedo GlassTable::at(float cosTheta, float alpha, bool inside) const {
  const Side& side = sides_[inside && twoSided_ ? 1 : 0];
  const float mu = std::clamp(cosTheta, 0.f, 1.f);
  const Row row = locate(alpha);
  const Piece* piece = &side.pieces.front();
  for (const Piece& p : side.pieces)
    if (mu > std::min(p.anchor, p.anchor + p.signedLength)) piece = &p;
  const float y = std::min(piece->unit(mu, alpha), 1.f) * static_cast<float>(piece->cells);
  const int i = std::min(static_cast<int>(y), piece->cells - 1);
  const CubicWeights cubic(y - static_cast<float>(i));
  const auto along = [&](std::size_t r) {
    return cubic.of(side.nodes.data() + r * static_cast<std::size_t>(side.rowNodes) + piece->firstNode + i);
  };
  Vec3f v = along(row.below);
  if (alphas_.size() > 1) {
    const Vec3f above = along(row.below + 1);
    // Beyond the first and the last row lies the parabola through the three at that end.
    const bool first = row.below == 0, last = row.below + 2 == alphas_.size();
    const Vec3f before = first ? (v - above) * 3.f + along(2) : along(row.below - 1);
    const Vec3f after = last ? (above - v) * 3.f + along(row.below - 1) : along(row.below + 2);
    const Vec3f rows[4] = {before, v, above, after};
    v = CubicWeights(row.part).of(rows);
  }
  v = {std::max(v.x, 0.f), std::max(v.y, 0.f), std::max(v.z, 0.f)};
  const float sum = v.x + v.y + v.z;
  if (sum > 1) v *= 1.f / sum;
  return {v.x, v.y, v.z};
}

}  // namespace lucarne
