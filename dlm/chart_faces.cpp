#include "dlm/chart_faces.h"

#include "dlm/chart_plane.h"

namespace lucarne {

ProjectionPlane::ProjectionPlane(Vec3d normal, Vec3d origin_) : origin(origin_) { planeAxes(normal, axisU, axisV); }

ChartFaces::ChartFaces(const HalfEdgeMesh& mesh_)
    : mesh(mesh_), normal(mesh_.vertices.size()), area(mesh_.vertices.size()) {
  for (std::uint32_t t = 0; t < normal.size(); ++t) {
    if (mesh.degenerate(t)) continue;
    const Vec3d n = mesh.scaledNormal(t);
    normal[t] = normalize(n);
    area[t] = 0.5 * length(n);
  }
}

PlaneTriangle ChartFaces::project(std::uint32_t triangle, const ProjectionPlane& plane) const {
  PlaneTriangle result;
  for (int k = 0; k < 3; ++k) {
    const Vec3d p = mesh.corner(triangle, k) - plane.origin;
    result[static_cast<std::size_t>(k)] = {dot(p, plane.axisU), dot(p, plane.axisV)};
  }
  return result;
}

Vec3d ChartFaces::meanNormal(const std::vector<std::uint32_t>& triangles) const {
  Vec3d sum;
  for (const std::uint32_t t : triangles) sum += normal[t] * area[t];
  return snappedNormal(sum);
}

double ChartFaces::areaOf(const std::vector<std::uint32_t>& triangles) const {
  double sum = 0;
  for (const std::uint32_t t : triangles) sum += area[t];
  return sum;
}

double ChartFaces::smallestCosine(const std::vector<std::uint32_t>& triangles, Vec3d direction) const {
  double least = 1;
  for (const std::uint32_t t : triangles) least = std::min(least, dot(normal[t], direction));
  return least;
}

}  // namespace lucarne
