#include "dlm/charts.h"

#include <numeric>

#include "dlm/chart_growth.h"
#include "dlm/chart_merge.h"
#include "dlm/chart_plane.h"
#include "dlm/chart_uv1.h"
#include "dlm/half_edge_mesh.h"

namespace lucarne {
namespace {

double extentOf(const Scene& scene) {
  Box box;
  for (const Vec3f p : scene.positions) {
    if (isFinite(p)) box.add(Vec3d(p));
  }
  return box.empty() ? 1 : std::max(maxComponent(box.extent()), 1e-30);
}

/// Largest first, so that charts begin in the middle of flat parts and slivers join them. Areas count in powers of two
/// only, off any round number: equal triangles stay in the order of the file however their areas were rounded.
std::vector<std::uint32_t> seedOrder(const ChartFaces& faces, double extent) {
  const std::size_t count = faces.area.size();
  std::vector<int> size(count);
  for (std::uint32_t t = 0; t < count; ++t) std::frexp(1.37 * faces.area[t] / (extent * extent), &size[t]);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return size[a] > size[b]; });
  return order;
}

/// Every triangle with area in one chart.
std::vector<GrownChart> partition(const ChartFaces& faces, double cosMaxAngle, double extent, double tolerance) {
  PlaneTriangleSet overlaps(2 * extent, tolerance);
  ChartGrower grower(faces, cosMaxAngle, overlaps);
  std::vector<GrownChart> charts;
  for (const std::uint32_t seed : seedOrder(faces, extent)) {
    if (grower.isFree(seed)) charts.push_back(grower.take(seed));
  }
  return mergeCharts(faces, std::move(charts), cosMaxAngle, overlaps);
}

std::vector<Vec3d> pointsOf(const HalfEdgeMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<Vec3d> points;
  points.reserve(3 * triangles.size());
  for (const std::uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) points.push_back(mesh.corner(t, k));
  }
  return points;
}

/// The chart and the places of its triangles' corners in it. All that a corner's place depends on is its mesh vertex.
Chart finishChart(const Scene& scene, const HalfEdgeMesh& mesh, GrownChart grown, double extent, ChartSet& set) {
  const ChartPlane plane = fitPlane(grown.normal, pointsOf(mesh, grown.triangles), 1e-9 * extent);
  Chart chart;
  chart.material = scene.triangles[grown.triangles[0]].material;
  chart.normal = plane.normal;
  chart.axisU = plane.axisU;
  chart.axisV = plane.axisV;
  chart.size = plane.size;
  chart.triangles = std::move(grown.triangles);
  std::sort(chart.triangles.begin(), chart.triangles.end());
  for (const std::uint32_t t : chart.triangles) {
    chart.smooth = chart.smooth || (t < scene.smooth.size() && scene.smooth[t] != 0);
    chart.area += 0.5 * length(scene.scaledNormal(t));
    for (int k = 0; k < 3; ++k) {
      const Vec2d uv = plane.project(mesh.corner(t, k));
      set.cornerUv[t][k] = {clampedInside(uv.x, plane.size.x), clampedInside(uv.y, plane.size.y)};
    }
  }
  return chart;
}

void orderBySmallestTriangle(ChartSet& set) {
  std::sort(set.charts.begin(), set.charts.end(),
            [](const Chart& a, const Chart& b) { return a.triangles[0] < b.triangles[0]; });
  for (std::uint32_t i = 0; i < set.charts.size(); ++i) {
    for (const std::uint32_t t : set.charts[i].triangles) set.chartOfTriangle[t] = i;
  }
}

/// Charts of the scene's own unwrapping; their triangles are taken out of the mesh.
void takeUv1Charts(const Scene& scene, HalfEdgeMesh& mesh, double minSize, ChartSet& set) {
  Uv1Islands found = findUv1Islands(scene, mesh);
  set.uv1Refused = std::move(found.refused);
  set.uv1Charts = found.islands.size();
  for (const auto& island : found.islands) {
    set.charts.push_back(uv1Chart(scene, island, minSize, set));
    for (const std::uint32_t t : island) {
      mesh.vertices[t].fill(kNone);
      for (EdgeLink& link : mesh.links[t]) {
        if (link.triangle != kNone) mesh.links[link.triangle][link.edge] = {};
        link = {};
      }
    }
  }
}

}  // namespace

ChartSet growCharts(const Scene& scene, const ChartOptions& options) {
  const double extent = extentOf(scene);
  const double tolerance = std::clamp(options.weldTolerance, 1e-12, 1e-2) * extent;
  HalfEdgeMesh mesh = buildHalfEdgeMesh(scene, tolerance);
  cutCreases(scene, mesh, options.creaseAngleDegrees);

  ChartSet set;
  set.chartOfTriangle.assign(scene.triangles.size(), kNone);
  set.cornerUv.resize(scene.triangles.size());
  if (options.useUv1) takeUv1Charts(scene, mesh, 1e-9 * extent, set);

  const ChartFaces faces(mesh);
  const double cosMaxAngle = cosDegrees(std::clamp(options.maxAngleDegrees, 0.1, 80.0));
  for (GrownChart& chart : partition(faces, cosMaxAngle, extent, tolerance)) {
    set.charts.push_back(finishChart(scene, mesh, std::move(chart), extent, set));
  }
  orderBySmallestTriangle(set);
  return set;
}

}  // namespace lucarne
