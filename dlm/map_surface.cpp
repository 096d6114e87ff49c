#include "dlm/map_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dlm/probe_closest.h"
#include "dlm/texel_layout_coverage.h"

namespace lucarne {
namespace {

/// Corners of a triangle in texels of its chart's rectangle.
std::array<Vec2d, 3> texelCorners(const Dlm& dlm, std::uint32_t triangle, const MapChart& chart) {
  std::array<Vec2d, 3> st;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2f uv = dlm.scene.atlasUv[dlm.scene.triangles[triangle].v[k]];
    st[k] = {static_cast<double>(uv.x) * dlm.maps.atlasWidth - chart.atlasX,
             static_cast<double>(uv.y) * dlm.maps.atlasHeight - chart.atlasY};
  }
  return st;
}

double areaOf(const std::array<Vec2d, 3>& t) {
  return 0.5 * std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x));
}

Vec3d flat(Vec2d p) { return {p.x, p.y, 0}; }

bool sameRectangles(const MapChart& a, const MapChart& b) {
  return a.width == b.width && a.height == b.height && a.atlasX == b.atlasX && a.atlasY == b.atlasY;
}

}  // namespace

TexelAreas::TexelAreas(const Dlm& dlm) {
  std::uint64_t count = 0;
  for (const MapChart& chart : dlm.maps.charts) {
    first_.push_back(count);
    count += static_cast<std::uint64_t>(chart.width) * static_cast<std::uint64_t>(chart.height);
  }
  area_.resize(count);
  const double square = dlm.scene.frame.scale * dlm.scene.frame.scale;
  for (std::uint32_t t = 0; t < dlm.scene.triangles.size(); ++t) {
    const std::uint32_t index = dlm.scene.chartOfTriangle[t];
    if (index == kNone) continue;
    const MapChart& chart = dlm.maps.charts[index];
    const std::array<Vec2d, 3> corners = texelCorners(dlm, t, chart);
    const double inTexels = areaOf(corners), metres = 0.5 * length(dlm.scene.scaledNormal(t)) * square;
    if (!(inTexels > 0)) continue;
    TexelCoverage coverage(chart.width, chart.height);
    for (const CoveredRun& run : coverage.of(corners)) {
      const auto first = first_[index] + static_cast<std::uint64_t>(run.y) * static_cast<std::uint64_t>(chart.width) +
                         static_cast<std::uint64_t>(run.x);
      for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(run.count); ++i) {
        area_[first + i] += run.area * metres / inTexels;
      }
    }
  }
}

Vec3d surfaceAt(const Dlm& dlm, std::uint32_t chart, Vec2d st) {
  double nearest = HUGE_VAL;
  Vec3d point{};
  for (std::uint32_t t = 0; t < dlm.scene.triangles.size(); ++t) {
    if (dlm.scene.chartOfTriangle[t] != chart) continue;
    const std::array<Vec2d, 3> c = texelCorners(dlm, t, dlm.maps.charts[chart]);
    const ClosestPoint closest = closestPoint(flat(st), flat(c[0]), flat(c[1]), flat(c[2]));
    if (!(closest.distance < nearest)) continue;
    nearest = closest.distance;
    point = Vec3d(dlm.scene.corner(t, 0)) * (1 - closest.b1 - closest.b2) + Vec3d(dlm.scene.corner(t, 1)) * closest.b1 +
            Vec3d(dlm.scene.corner(t, 2)) * closest.b2;
  }
  return dlm.scene.frame.toWorld(point);
}

bool sameLayout(const Dlm& a, const Dlm& b) {
  const Scene &sa = a.scene, &sb = b.scene;
  if (!(sa.frame.origin == sb.frame.origin) || sa.frame.scale != sb.frame.scale) return false;
  if (sa.positions != sb.positions || sa.atlasUv != sb.atlasUv || sa.chartOfTriangle != sb.chartOfTriangle)
    return false;
  const auto sameCorners = [](const Triangle& x, const Triangle& y) { return std::equal(x.v, x.v + 3, y.v); };
  if (!std::equal(sa.triangles.begin(), sa.triangles.end(), sb.triangles.begin(), sb.triangles.end(), sameCorners))
    return false;
  return a.maps.atlasWidth == b.maps.atlasWidth && a.maps.atlasHeight == b.maps.atlasHeight &&
         std::equal(a.maps.charts.begin(), a.maps.charts.end(), b.maps.charts.begin(), b.maps.charts.end(),
                    sameRectangles);
}

}  // namespace lucarne
