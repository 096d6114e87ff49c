// Charts: connected sets of triangles of one material, one-to-one in their own texture rectangle. Either the scene's own
// unwrapping (chart_uv1.h), or grown:
//
// Charts grow across the edges of one material while (a) every triangle's normal stays within an angle of the chart's
// normal and (b) the orthogonal projection onto the chart's plane stays one-to-one. Adjacency is by position, not
// by index: vertices are welded within a tolerance relative to the scene, and edges with more than two faces, or with
// two faces that wind the same way, do not connect (OpenMesh half-edges); triangles that lie on one another count as
// layers, each connected by itself. Smooth triangles do not join where their vertex normals differ, flat ones not where
// they meet at more than the crease angle. Zero-area triangles belong to no chart.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tracer/scene/scene.h"

namespace lucarne {

struct ChartOptions {
  double maxAngleDegrees = 40;     // largest angle between a triangle's normal and the chart's, at most 80
  double weldTolerance = 1e-6;     // relative to the scene's extent (about one local unit)
  double creaseAngleDegrees = 20;  // flat-shaded triangles that meet at more than this are not joined
  bool useUv1 = false;             // where the scene has an unwrapping of its own that can be used (chart_uv1.h)
};

struct Chart {
  std::uint32_t material = 0;
  bool smooth = false;                   // some triangle has interpolated normals
  Vec3d normal{};                        // unit plane normal, on the front side
  Vec3d axisU{}, axisV{};                // unit, axisU × axisV = normal
  Vec2d size{};                          // extent along axisU, axisV in local units; > 0
  double area = 0;                       // of its triangles, local units²
  std::vector<std::uint32_t> triangles;  // ascending
};

struct ChartSet {
  std::vector<Chart> charts;
  std::vector<std::uint32_t> chartOfTriangle;  // kNone for degenerate triangles
  std::vector<std::array<Vec2f, 3>> cornerUv;  // per triangle: place in its chart, local units, inside [0,size]
  std::size_t uv1Charts = 0;                   // of the scene's own unwrapping
  std::vector<std::string> uv1Refused;         // meshes whose unwrapping cannot be used, and why
};

/// Deterministic: depends on the scene's triangles and options alone. Charts are ordered by their smallest triangle.
ChartSet growCharts(const Scene& scene, const ChartOptions& options = {});

}  // namespace lucarne
