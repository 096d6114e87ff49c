// Growth of single charts over a half-edge mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "dlm/chart_faces.h"
#include "dlm/chart_overlap.h"

namespace lucarne {

/// Cuts the links between triangles that do not continue each other's shading: smooth ones where their vertex normals
/// differ at the edge, flat ones where they meet at more than the crease angle.
void cutCreases(const Scene& scene, HalfEdgeMesh& mesh, double creaseAngleDegrees);

/// Cosine by series: the same bits on every processor (a layout must not depend on the machine).
double cosDegrees(double degrees);

class ChartGrower {
 public:
  /// `set` is the grower's to use while it lives.
  ChartGrower(const ChartFaces& faces, double cosMaxAngle, PlaneTriangleSet& set);

  /// Grows a chart of free triangles from the seed and takes them.
  GrownChart take(std::uint32_t seed);
  bool isFree(std::uint32_t triangle) const { return free_[triangle]; }

 private:
  std::vector<std::uint32_t> grow(std::uint32_t seed, Vec3d normal);
  void addWithNeighbours(std::uint32_t triangle, std::vector<std::uint32_t>& chart);
  bool isOneToOne(const std::vector<std::uint32_t>& chart, Vec3d normal);

  const ChartFaces& faces_;
  double cosMaxAngle_;
  PlaneTriangleSet& set_;
  std::vector<bool> free_;
  std::vector<std::uint32_t> triedIn_;  // the growth that last tried each triangle
  std::uint32_t growth_ = 0;
  std::vector<std::uint32_t> flatFront_, curvedFront_;  // queues; their heads:
  std::size_t flatHead_ = 0, curvedHead_ = 0;
};

}  // namespace lucarne
