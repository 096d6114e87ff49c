#include "dlm/direction_tents.h"

#include <cmath>

#include "dlm/spherical_polygon.h"

namespace lucarne {

namespace {

// Radon's rule of seven points on the triangle, exact for polynomials of degree 5 (Radon 1948; Stroud 1971, T2: 5-1).
// Barycentric coordinates (1 − 2a, a, a) in turn.
constexpr double kMiddleWeight = 9.0 / 40, kNearWeight = 0.13239415278850619, kFarWeight = 0.12593918054482715;
constexpr double kNear = 0.47014206410511509, kFar = 0.10128650732345634;

// Flat triangles are cut until no edge is longer, over their distance: the rule then errs by about 1e-6.
constexpr double kLongestEdge = 0.3;
// Of flat triangles from the origin: that of a tetrahedron is 1/3. Slivers have none.
constexpr double kLeastDepth = 0.3;

using FlatTriangle = std::array<Vec3d, 3>;

// λ of a corner at a point along w: barycentric in the triangle of ψ, wherever in it the point lies.
struct Tent {
  FlatTriangle dual;
  std::size_t corner;
  double at(Vec3d w) const { return dot(dual[corner], w) / dot(dual[0] + dual[1] + dual[2], w); }
};

// A flat triangle seen from the origin: dω = det/|p|³ of the barycentric coordinates, that is 2 areas of a unit
// triangle.
void addPoint(const Tent& tent, Vec3d p, double weight, TentIntegral& sum) {
  const double square = dot(p, p), l = std::sqrt(square), light = weight * tent.at(p) / (square * l);
  const Vec3d w = p / l;
  sum.solidAngle += light;
  sum.moment += w * light;
  for (int i = 0; i < 3; ++i) sum.second[static_cast<std::size_t>(i)] += w * (light * w[i]);
}

void addFlat(const Tent& tent, const FlatTriangle& c, TentIntegral& sum) {
  const double det = dot(c[0], cross(c[1] - c[0], c[2] - c[0])) / 2;
  addPoint(tent, (c[0] + c[1] + c[2]) / 3, det * kMiddleWeight, sum);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d others = c[(k + 1) % 3] + c[(k + 2) % 3];
    addPoint(tent, c[k] * (1 - 2 * kNear) + others * kNear, det * kNearWeight, sum);
    addPoint(tent, c[k] * (1 - 2 * kFar) + others * kFar, det * kFarWeight, sum);
  }
}

void addTriangle(const Tent& tent, const FlatTriangle& c, TentIntegral& sum) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, length(c[(k + 1) % 3] - c[k]));
  const Vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
  const double depth = std::max(kLeastDepth, dot(c[0], normal) / length(normal));
  const int cuts = std::max(1, static_cast<int>(std::ceil(longest / (kLongestEdge * depth))));
  const Vec3d u = (c[1] - c[0]) / cuts, v = (c[2] - c[0]) / cuts;
  for (int i = 0; i < cuts; ++i) {
    for (int j = 0; i + j < cuts; ++j) {
      const Vec3d p = c[0] + u * i + v * j;
      addFlat(tent, {p, p + u, p + v}, sum);
      if (i + j + 1 < cuts) addFlat(tent, {p + u, p + u + v, p + v}, sum);
    }
  }
}

void addPolygon(const Tent& tent, std::span<const Vec3d> polygon, TentIntegral& sum) {
  for (std::size_t i = 2; i < polygon.size(); ++i) addTriangle(tent, {polygon[0], polygon[i - 1], polygon[i]}, sum);
}

Tent tentOf(const DirectionTriangles::Triangle& t, std::size_t corner) {
  return {{Vec3d(t.dual[0]), Vec3d(t.dual[1]), Vec3d(t.dual[2])}, corner};
}

// All of the polygon's light, as if λ were 1.
TentIntegral evenly(std::span<const Vec3d> polygon) {
  TentIntegral sum{solidAngle(polygon), moment(polygon), {}};
  sum.second = {momentAlong(polygon, {1, 0, 0}), momentAlong(polygon, {0, 1, 0}), momentAlong(polygon, {0, 0, 1})};
  return sum;
}

}  // namespace

TentIntegral& TentIntegral::operator+=(const TentIntegral& o) {
  solidAngle += o.solidAngle;
  moment += o.moment;
  for (std::size_t i = 0; i < 3; ++i) second[i] += o.second[i];
  return *this;
}

DirectionTents::DirectionTents(const std::vector<Vec3d>& directions, const DirectionTriangles& triangles)
    : directions_(directions), triangles_(triangles), first_(directions.size() + 1) {
  for (const DirectionTriangles::Triangle& t : triangles.triangles()) {
    for (const std::uint16_t psi : t.psi) ++first_[psi + 1u];
    whole_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      addTriangle(tentOf(t, k), {directions[t.psi[0]], directions[t.psi[1]], directions[t.psi[2]]}, whole_.back()[k]);
  }
  for (std::size_t psi = 0; psi < directions.size(); ++psi) first_[psi + 1] += first_[psi];
  around_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < whole_.size(); ++i)
    for (const std::uint16_t psi : triangles.triangles()[i].psi) around_[next[psi]++] = i;
}

TentIntegral DirectionTents::above(int psi, Vec3d n, const std::function<bool(int)>& isMember) const {
  const auto p = static_cast<std::size_t>(psi);
  TentIntegral sum;
  for (std::uint32_t i = first_[p]; i < first_[p + 1]; ++i) {
    const DirectionTriangles::Triangle& t = triangles_.triangles()[around_[i]];
    const std::size_t corner = t.psi[0] == psi ? 0 : t.psi[1] == psi ? 1 : 2;
    int up = 0;
    for (const std::uint16_t other : t.psi) up += dot(directions_[other], n) >= 0;
    if (up == 3) sum += whole_[around_[i]][corner];
    if (up == 1 || up == 2) sum += cutTriangle(t, corner, n, isMember);
  }
  return sum;
}

TentIntegral DirectionTents::cutTriangle(const DirectionTriangles::Triangle& t, std::size_t corner, Vec3d n,
                                         const std::function<bool(int)>& isMember) const {
  SphericalPolygon piece = clip(FlatTriangle{directions_[t.psi[0]], directions_[t.psi[1]], directions_[t.psi[2]]}, n);
  std::array<bool, 3> member{};
  for (std::size_t k = 0; k < 3; ++k) member[k] = isMember(t.psi[k]);
  TentIntegral sum;
  if (member[0] && member[1] && member[2]) {
    addPolygon(tentOf(t, corner), piece.span(), sum);
    return sum;
  }
  if (!member[corner]) return sum;
  for (std::size_t k = 0; k < 3; ++k)
    if (k != corner && member[k]) piece = clip(piece.span(), directions_[t.psi[corner]] - directions_[t.psi[k]]);
  return evenly(piece.span());
}

}  // namespace lucarne
