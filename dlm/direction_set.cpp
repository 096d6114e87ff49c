#include "dlm/direction_set.h"

#include "base/error.h"
#include "dlm/direction_set_cells.h"

namespace lucarne {

namespace {

// Cells that reach above a horizon by less are left out: no more than rounding of a normal.
constexpr double kTinySolidAngle = 1e-9;
// Widens the cone around a cell that decides without clipping, against rounding of its vertices.
constexpr double kConeMargin = 1e-9;

// Sine of the smallest angle that holds the whole cell, or 2 when that is not below 90 degrees: such a cell is always
// clipped.
double coneSine(Vec3d axis, const std::vector<SphericalPolygon>& pieces) {
  double cosine = 1;
  for (const SphericalPolygon& piece : pieces) {
    for (const Vec3d& v : piece.span()) cosine = std::min(cosine, dot(v, axis));
  }
  return cosine > 0 ? std::sqrt(1 - cosine * cosine) + kConeMargin : 2;
}

ClippedCell finish(const SphericalIntegral& sum, Vec3d n) {
  return {sum.solidAngle, sum.moment, std::max(0.0, dot(n, sum.moment))};
}

}  // namespace

DirectionSet::DirectionSet(int count, DirectionFilter filter) {
  LUCARNE_CHECK_LE(1, count);
  LUCARNE_CHECK_LE(count, 65535);
  directions_ = spreadDirections(count);
  for (const Vec3d& d : directions_) directionsF_.push_back(Vec3f(d));
  buildCells();
  buildLookup();
  if (filter == DirectionFilter::linear && count >= 4) shared_ = std::make_shared<const Shared>(directions_);
}

void DirectionSet::buildCells() {
  const VoronoiSphere voronoi(directions_);
  firstPiece_.push_back(0);
  for (std::size_t psi = 0; psi < directions_.size(); ++psi) {
    const std::vector<SphericalPolygon> polygons = voronoi.cell(psi);
    SphericalIntegral whole;
    for (const SphericalPolygon& polygon : polygons) {
      const SphericalIntegral part = integrate(polygon.span());
      pieces_.push_back(
          {static_cast<std::uint32_t>(vertices_.size()), static_cast<std::uint32_t>(polygon.count), part});
      vertices_.insert(vertices_.end(), polygon.span().begin(), polygon.span().end());
      whole += part;
    }
    firstPiece_.push_back(static_cast<std::uint32_t>(pieces_.size()));
    cells_.push_back({whole, coneSine(directions_[psi], polygons)});
  }
}

SphericalIntegral DirectionSet::above(int psi, Vec3d n) const {
  const std::size_t i = static_cast<std::size_t>(psi);
  const double height = dot(directions_[i], n);
  if (height >= cells_[i].coneSine) return cells_[i].whole;
  if (height <= -cells_[i].coneSine) return {};
  SphericalIntegral sum;
  for (std::uint32_t k = firstPiece_[i]; k < firstPiece_[i + 1]; ++k) {
    const Piece& piece = pieces_[k];
    const std::span<const Vec3d> polygon(vertices_.data() + piece.first, piece.count);
    std::size_t inside = 0;
    for (const Vec3d& v : polygon) inside += dot(v, n) >= 0;
    if (inside == polygon.size()) sum += piece.whole;
    if (inside > 0 && inside < polygon.size()) sum += integrate(clip(polygon, n).span());
  }
  return sum;
}

TentIntegral DirectionSet::tentAbove(int psi, Vec3d n, Members members) const {
  return shared_->tents.above(psi, n, [&](int other) { return members == Members::all || reaches(other, n); });
}

ClippedCell DirectionSet::clippedCell(int psi, Vec3d n, Members members) const {
  if (!shared_) return finish(above(psi, n), n);
  const TentIntegral tent = tentAbove(psi, n, members);
  return finish({tent.solidAngle, tent.moment}, n);
}

Vec3d DirectionSet::cosineMoment(int psi, Vec3d n, Members members) const {
  if (shared_) return tentAbove(psi, n, members).secondAlong(n);
  const std::size_t i = static_cast<std::size_t>(psi);
  Vec3d sum{};
  for (std::uint32_t k = firstPiece_[i]; k < firstPiece_[i + 1]; ++k) {
    const std::span<const Vec3d> polygon(vertices_.data() + pieces_[k].first, pieces_[k].count);
    const bool whole = std::all_of(polygon.begin(), polygon.end(), [&](const Vec3d& v) { return dot(v, n) >= 0; });
    sum += whole ? momentAlong(polygon, n) : momentAlong(clip(polygon, n).span(), n);
  }
  return sum;
}

ClippedCell DirectionSet::cell(int psi) const {
  const SphericalIntegral& whole = cells_[static_cast<std::size_t>(psi)].whole;
  return {whole.solidAngle, whole.moment, 0};
}

bool DirectionSet::reaches(int psi, Vec3d n) const { return above(psi, n).solidAngle > kTinySolidAngle; }

}  // namespace lucarne
