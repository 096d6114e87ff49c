// What every chart set must satisfy, and small meshes to try it on.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>
#include <set>

#include "dlm/charts.h"
#include "tests/support/scene_builder.h"
#include "tracer/scene/scene_cleanup.h"

namespace lucarne::test {

inline double triangleArea(const Scene& scene, std::uint32_t t) { return 0.5 * length(scene.scaledNormal(t)); }

/// The scene's flat triangles get the vertex normals that `normalAt` gives in metres, and count as smooth.
inline void makeSmooth(Scene& scene, const std::function<Vec3d(Vec3d)>& normalAt) {
  for (std::size_t v = 0; v < scene.positions.size(); ++v) {
    scene.normals[v] = Vec3f(normalize(normalAt(scene.frame.toWorld(Vec3d(scene.positions[v])))));
  }
  scene.smooth.assign(scene.triangles.size(), 1);
}

/// A surface over [0,1]², nu × nv quads, every quad with four vertices of its own.
inline Scene surface(int nu, int nv, const std::function<Vec3d(double, double)>& point) {
  SceneBuilder builder;
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const auto at = [&](int di, int dj) { return point(double(i + di) / nu, double(j + dj) / nv); };
      builder.addQuad(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
    }
  }
  return builder.build();
}

inline Vec3d spherePoint(double u, double v) {
  const double pi = 3.14159265358979323846, phi = u == 1 ? 0 : 2 * pi * u, theta = pi * v;
  const double s = v == 0 || v == 1 ? 0 : std::sin(theta);
  return {s * std::cos(phi), std::cos(theta), -s * std::sin(phi)};
}

/// Poles below: v runs from the north pole, u eastward seen from inside, so quads wind outward when v is flipped.
inline Scene sphere(int nu, int nv, double radius = 1) {
  Scene scene = surface(nu, nv, [&](double u, double v) { return spherePoint(u, 1 - v) * radius; });
  makeSmooth(scene, [](Vec3d p) { return p; });
  return scene;
}

struct UvTriangle {
  Vec2d a, b, c;
  double area() const { return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)); }
  Vec2d at(double s, double t) const { return a + (b - a) * s + (c - a) * t; }
  /// Least distance to an edge line, positive inside.
  double depth(Vec2d p) const {
    const auto side = [p](Vec2d u, Vec2d v) {
      const Vec2d e = v - u;
      const double l = std::sqrt(dot(e, e));
      return l > 0 ? (e.x * (p.y - u.y) - e.y * (p.x - u.x)) / l : -1.0;
    };
    return std::min({side(a, b), side(b, c), side(c, a)});
  }
};

inline UvTriangle uvOf(const ChartSet& set, std::uint32_t t) {
  const auto& c = set.cornerUv[t];
  return {{c[0].x, c[0].y}, {c[1].x, c[1].y}, {c[2].x, c[2].y}};
}

/// Every triangle with area in exactly one chart, in ascending order; charts ordered by their first; areas add up.
inline void expectPartition(const Scene& scene, const ChartSet& set) {
  ASSERT_EQ(set.chartOfTriangle.size(), scene.triangles.size());
  ASSERT_EQ(set.cornerUv.size(), scene.triangles.size());
  std::vector<int> seen(scene.triangles.size(), 0);
  std::uint32_t previousFirst = 0;
  for (std::uint32_t c = 0; c < set.charts.size(); ++c) {
    const Chart& chart = set.charts[c];
    ASSERT_FALSE(chart.triangles.empty());
    ASSERT_TRUE(std::is_sorted(chart.triangles.begin(), chart.triangles.end()));
    ASSERT_TRUE(c == 0 || previousFirst < chart.triangles[0]);
    previousFirst = chart.triangles[0];
    double area = 0;
    for (const std::uint32_t t : chart.triangles) {
      ++seen[t];
      area += triangleArea(scene, t);
      ASSERT_EQ(set.chartOfTriangle[t], c);
      ASSERT_EQ(scene.triangles[t].material, chart.material);
    }
    ASSERT_NEAR(chart.area, area, 1e-12 * area);
  }
  for (std::uint32_t t = 0; t < seen.size(); ++t) {
    ASSERT_EQ(seen[t], set.chartOfTriangle[t] == kNone ? 0 : 1);
    if (set.chartOfTriangle[t] == kNone) {
      ASSERT_TRUE(isSkipped(scene, t) || triangleArea(scene, t) < 1e-9);
    }
  }
}

/// Orthonormal axes, corners inside the rectangle, which they touch on every side; triangles within the angle.
inline void expectPlanes(const Scene& scene, const ChartSet& set, const ChartOptions& options = {}) {
  for (const Chart& chart : set.charts) {
    ASSERT_NEAR(length(chart.normal), 1, 1e-12);
    ASSERT_NEAR(length(chart.axisU), 1, 1e-12);
    ASSERT_NEAR(length(cross(chart.axisU, chart.axisV) - chart.normal), 0, 1e-12);
    ASSERT_GT(chart.size.x, 0);
    ASSERT_GT(chart.size.y, 0);
    Vec2d hi{};
    double leastCosine = 1;
    for (const std::uint32_t t : chart.triangles) {
      for (const Vec2f uv : set.cornerUv[t]) {
        ASSERT_GE(uv.x, 0);
        ASSERT_GE(uv.y, 0);
        hi = {std::max<double>(hi.x, uv.x), std::max<double>(hi.y, uv.y)};
      }
      // A sliver's normal is known to its rounding only.
      if (triangleArea(scene, t) > 1e-8)
        leastCosine = std::min(leastCosine, dot(normalize(scene.scaledNormal(t)), chart.normal));
    }
    ASSERT_LE(hi.x, chart.size.x);
    ASSERT_LE(hi.y, chart.size.y);
    ASSERT_GE(hi.x, chart.size.x * (1 - 1e-6) - 1e-8);
    ASSERT_GE(leastCosine, std::cos(options.maxAngleDegrees * 3.14159265358979 / 180) - 1e-3);
  }
}

/// Random points of random triangles lie in no other triangle of their chart, but for rounding.
inline void expectNoOverlap(const ChartSet& set, int points = 2000, double depth = 2e-6) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  for (const Chart& chart : set.charts) {
    const auto count = static_cast<int>(chart.triangles.size());
    if (count < 2) continue;
    const int share = std::max(3, std::min(points, 20'000'000 / count) * count / static_cast<int>(set.cornerUv.size()));
    for (int i = 0; i < share; ++i) {
      const std::uint32_t t =
          chart.triangles[std::uniform_int_distribution<std::size_t>(0, chart.triangles.size() - 1)(random)];
      double s = uniform(random), r = uniform(random);
      if (s + r > 1) {
        s = 1 - s;
        r = 1 - r;
      }
      const UvTriangle own = uvOf(set, t);
      const Vec2d p = own.at(s, r);
      if (own.depth(p) <= depth) continue;
      for (const std::uint32_t other : chart.triangles) {
        if (other != t) {
          ASSERT_LE(uvOf(set, other).depth(p), depth) << t << " and " << other;
        }
      }
    }
  }
}

inline ChartSet growChecked(const Scene& scene, const ChartOptions& options = {}) {
  ChartSet set = growCharts(scene, options);
  expectPartition(scene, set);
  expectPlanes(scene, set, options);
  expectNoOverlap(set);
  return set;
}

}  // namespace lucarne::test
