// Where the directions of Ω lie: a spherical Fibonacci lattice, relaxed, turned.
#include "dlm/direction_set_cells.h"

namespace lucarne {

namespace {

// Lloyd's relaxation makes the cells of a small set more equal and rounder; the lattice is as good already in a large
// one.
constexpr int kRelaxedCount = 512;
constexpr int kLloydSteps = 30;

// Swinbank and Purser 2006 with offset ½: heights at the midpoints of n equal bands, turned by the golden angle π(3 −
// √5) from one to the next. The turn is a product of complex numbers; the C library's sines differ between machines.
std::vector<Vec3d> fibonacciLattice(int count) {
  constexpr double kCos = -0.73736887807831990, kSin = 0.67549029426152364;  // of the golden angle
  std::vector<Vec3d> points;
  points.reserve(static_cast<std::size_t>(count));
  double c = 1, s = 0;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const double r = std::sqrt(1 - z * z);
    points.push_back(normalize(Vec3d{r * c, r * s, z}));
    const double turned = c * kCos - s * kSin;
    s = c * kSin + s * kCos;
    c = turned;
    const double l = std::sqrt(c * c + s * s);
    c /= l;
    s /= l;
  }
  return points;
}

// The centroid of a cell, up to its length.
Vec3d cellMoment(const VoronoiSphere& voronoi, std::size_t site) {
  Vec3d sum{};
  for (const SphericalPolygon& piece : voronoi.cell(site)) sum += moment(piece.span());
  return sum;
}

std::vector<Vec3d> lloydStep(const std::vector<Vec3d>& points) {
  const VoronoiSphere voronoi(points);
  std::vector<Vec3d> moved(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) moved[i] = normalize(cellMoment(voronoi, i));
  return moved;
}

struct Rotation {
  Vec3d rowX, rowY, rowZ;
  Vec3d operator()(Vec3d v) const { return {dot(rowX, v), dot(rowY, v), dot(rowZ, v)}; }
};

Rotation fromQuaternion(double w, double x, double y, double z) {
  const double l = std::sqrt(w * w + x * x + y * y + z * z);
  w /= l, x /= l, y /= l, z /= l;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

// The k-th of a fixed sequence of generic rotations: quaternions of an additive recurrence (powers of the root of
// x⁵ = x + 1, Roberts 2018) over the cube [−½, ½)⁴.
Rotation genericRotation(int k) {
  constexpr double kSteps[4] = {0.85667488385450287, 0.73389185662712599, 0.62870672103780863, 0.53859725722361005};
  double q[4];
  for (int i = 0; i < 4; ++i) {
    const double x = 0.5 + (k + 1) * kSteps[i];
    q[i] = x - std::floor(x) - 0.5;
  }
  return fromQuaternion(q[0], q[1], q[2], q[3]);
}

// Sine of the smallest angle between a point and a plane of two axes, after turning.
double axisClearance(const std::vector<Vec3d>& points, const Rotation& rotation, double enough) {
  double smallest = 1;
  for (const Vec3d& p : points) {
    const Vec3d v = rotation(p);
    smallest = std::min({smallest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (smallest < enough) break;
  }
  return smallest;
}

// Of the sequence, the rotation that keeps the points farthest from the planes of the axes: most floors and walls are
// parallel to one, and a ψ in such a plane would have nearly no irradiance there and an ill-defined part above the
// horizon.
Rotation chooseRotation(const std::vector<Vec3d>& points) {
  constexpr int kCandidates = 256;
  Rotation best = genericRotation(0);
  double clearance = axisClearance(points, best, 0);
  for (int k = 1; k < kCandidates; ++k) {
    const Rotation candidate = genericRotation(k);
    const double c = axisClearance(points, candidate, clearance);
    if (c > clearance) {
      clearance = c;
      best = candidate;
    }
  }
  return best;
}

}  // namespace

std::vector<Vec3d> spreadDirections(int count) {
  std::vector<Vec3d> points = fibonacciLattice(count);
  if (count > 1 && count <= kRelaxedCount) {
    for (int step = 0; step < kLloydSteps; ++step) points = lloydStep(points);
  }
  const Rotation rotation = chooseRotation(points);
  for (Vec3d& p : points) p = normalize(rotation(p));
  return points;
}

}  // namespace lucarne
