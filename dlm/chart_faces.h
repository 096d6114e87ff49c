// Normals and areas of a half-edge mesh's triangles, and of sets of them.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/chart_overlap.h"
#include "dlm/half_edge_mesh.h"

namespace lucarne {

inline constexpr double kCosFlat = 1 - 5e-7;  // 1e-3 rad: one plane but for rounding

/// A chart while it is made: all its triangles are within the largest angle of its normal, and its projection along the
/// normal is one-to-one.
struct GrownChart {
  Vec3d normal{};
  std::vector<std::uint32_t> triangles;  // in the order of growth
};

struct ProjectionPlane {
  Vec3d axisU, axisV, origin;
  ProjectionPlane(Vec3d normal, Vec3d origin_);
};

/// Degenerate triangles have normal and area 0.
struct ChartFaces {
  const HalfEdgeMesh& mesh;
  std::vector<Vec3d> normal;  // unit
  std::vector<double> area;

  explicit ChartFaces(const HalfEdgeMesh& mesh_);
  PlaneTriangle project(std::uint32_t triangle, const ProjectionPlane& plane) const;
  /// Unit mean normal, weighted by area; exactly an axis where it is one but for rounding.
  Vec3d meanNormal(const std::vector<std::uint32_t>& triangles) const;
  double areaOf(const std::vector<std::uint32_t>& triangles) const;
  /// Of the angle between a triangle's normal and `direction`.
  double smallestCosine(const std::vector<std::uint32_t>& triangles, Vec3d direction) const;
};

}  // namespace lucarne
