// Growth of single charts over a half-edge mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dlm/chart_overlap.h"
#include "dlm/charts.h"
#include "dlm/half_edge_mesh.h"

namespace lucarne {

/// Cuts the links between triangles that do not continue each other's shading: smooth ones where their vertex normals
/// differ at the edge, flat ones where they meet at more than the crease angle.
void cutCreases(const Scene& scene, HalfEdgeMesh& mesh, double creaseAngleDegrees);

/// Cosine by series: the same bits on every processor (a layout must not depend on the machine).
double cosDegrees(double degrees);

struct GrownChart {
  Vec3d normal{};
  std::vector<std::uint32_t> triangles;  // in the order of growth
};

class ChartGrower {
 public:
  /// `extent`: of the scene, local units; `tolerance`: depth of overlap that rounding explains, local units.
  ChartGrower(const HalfEdgeMesh& mesh, double maxAngleDegrees, double extent, double tolerance);

  /// Grows a chart of free triangles from the seed and takes them. All its triangles are within the angle of its normal,
  /// and its projection along the normal is one-to-one.
  GrownChart take(std::uint32_t seed);
  bool isFree(std::uint32_t triangle) const { return free_[triangle]; }
  double areaOf(std::uint32_t triangle) const { return area_[triangle]; }

 private:
  struct Plane {
    Vec3d normal, axisU, axisV, origin;
  };
  Plane planeThrough(std::uint32_t seed, Vec3d normal) const;
  PlaneTriangle project(std::uint32_t triangle, const Plane& plane) const;
  std::vector<std::uint32_t> grow(std::uint32_t seed, Vec3d normal);
  void addWithNeighbours(std::uint32_t triangle, std::vector<std::uint32_t>& chart);
  Vec3d meanNormal(const std::vector<std::uint32_t>& chart) const;
  double areaOf(const std::vector<std::uint32_t>& chart) const;
  double smallestCosine(const std::vector<std::uint32_t>& chart, Vec3d normal) const;
  bool isOneToOne(const std::vector<std::uint32_t>& chart, Vec3d normal);

  const HalfEdgeMesh& mesh_;
  double cosMaxAngle_;
  std::vector<bool> free_;
  std::vector<Vec3d> normal_;  // unit
  std::vector<double> area_;
  std::vector<std::uint32_t> triedIn_;  // the growth that last tried each triangle
  std::uint32_t growth_ = 0;
  PlaneTriangleSet set_;
  std::vector<std::uint32_t> flatFront_, curvedFront_;  // queues; their heads:
  std::size_t flatHead_ = 0, curvedHead_ = 0;
};

}  // namespace lucarne
