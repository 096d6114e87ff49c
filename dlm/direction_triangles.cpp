#include "dlm/direction_triangles.h"

#include "base/error.h"
#include "dlm/spherical_hull.h"

namespace lucarne {

namespace {

constexpr int kSmallestStarts = 32, kLargestStarts = 1024;
constexpr std::size_t kGridCellsPerTriangle = 8;

int gridSizeFor(std::size_t triangles) {
  int size = kSmallestStarts;
  while (size < kLargestStarts && static_cast<std::size_t>(size * size) < kGridCellsPerTriangle * triangles) size *= 2;
  return size;
}

DirectionTriangles::Triangle triangleOf(const HullTriangle& hull, const std::vector<Vec3d>& directions) {
  DirectionTriangles::Triangle t;
  t.across = hull.across;
  std::array<Vec3d, 3> v;
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = directions[hull.v[k]];
    t.psi[k] = static_cast<std::uint16_t>(hull.v[k]);
  }
  const double det = dot(v[0], cross(v[1] - v[0], v[2] - v[0]));
  LUCARNE_CHECK_LT(0.0, det);  // the origin is inside the hull
  for (std::size_t k = 0; k < 3; ++k) t.dual[k] = Vec3f(cross(v[(k + 1) % 3], v[(k + 2) % 3]) / det);
  return t;
}

}  // namespace

DirectionTriangles::DirectionTriangles(const std::vector<Vec3d>& directions) {
  LUCARNE_CHECK_LE(directions.size(), std::size_t{65535});
  for (const HullTriangle& hull : sphericalHull(directions)) triangles_.push_back(triangleOf(hull, directions));
  gridSize_ = gridSizeFor(triangles_.size());
  std::uint32_t t = 0;  // from cell to cell it is not far
  for (int y = 0; y < gridSize_; ++y) {
    for (int x = 0; x < gridSize_; ++x) {
      const Vec3f w(octahedronPoint((2 * x + 1.0) / gridSize_ - 1, (2 * y + 1.0) / gridSize_ - 1));
      for (int step = 0; step < kMostSteps; ++step) {
        const std::array<Vec3f, 3>& dual = triangles_[t].dual;
        std::size_t least = 0;
        for (std::size_t k = 1; k < 3; ++k)
          if (dot(dual[k], w) < dot(dual[least], w)) least = k;
        if (dot(dual[least], w) >= 0) break;
        t = triangles_[t].across[least];
      }
      start_.push_back(t);
    }
  }
}

}  // namespace lucarne
