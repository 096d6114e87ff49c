// Exact coverage of texels by a triangle.
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"

namespace lucarne {

/// `count` texels side by side, each covered by `area` texel² of the triangle.
struct CoveredRun {
  int x, y, count;
  double area;
};

/// Clips the triangle (texel coordinates, either winding) against the texels of a width × height rectangle. Coordinates
/// outside are clamped to the border. Texels that it does not cover have no run; one without area gives no runs at all.
class TexelCoverage {
 public:
  TexelCoverage(int width, int height) : width_(width), height_(height) {}
  /// Valid until the next call.
  const std::vector<CoveredRun>& of(const std::array<Vec2d, 3>& triangle);

 private:
  struct Polygon {  // convex, at most 3 corners and one more for each of 4 clips
    std::array<Vec2d, 7> corner;
    int count = 0;
    void add(Vec2d p) { corner[static_cast<std::size_t>(count++)] = p; }
    double area() const;
    double lowest(int axis) const;
    double highest(int axis) const;
  };
  static void split(const Polygon& polygon, int axis, double at, Polygon& below, Polygon& above);
  void coverRow(const Polygon& band, int y, bool fullHeight);
  static void wholeTexels(const Polygon& band, int y, int& first, int& end);
  void add(int x, int y, int count, double area);

  int width_, height_;
  std::vector<CoveredRun> runs_;
};

}  // namespace lucarne
