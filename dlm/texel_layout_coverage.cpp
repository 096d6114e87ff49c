#include "dlm/texel_layout_coverage.h"

namespace lucarne {
namespace {

double along(Vec2d p, int axis) { return axis == 0 ? p.x : p.y; }

}  // namespace

double TexelCoverage::Polygon::area() const {
  double twice = 0;  // about the first corner: small polygons far from the origin lose nothing
  for (int i = 1; i + 1 < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec2d a = corner[k] - corner[0], b = corner[k + 1] - corner[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

double TexelCoverage::Polygon::lowest(int axis) const {
  double least = along(corner[0], axis);
  for (int i = 1; i < count; ++i) least = std::min(least, along(corner[static_cast<std::size_t>(i)], axis));
  return least;
}

double TexelCoverage::Polygon::highest(int axis) const {
  double most = along(corner[0], axis);
  for (int i = 1; i < count; ++i) most = std::max(most, along(corner[static_cast<std::size_t>(i)], axis));
  return most;
}

/// Cuts at coordinate `at` of the axis. A cut point has exactly that coordinate, so that pieces fit without a gap.
void TexelCoverage::split(const Polygon& polygon, int axis, double at, Polygon& below, Polygon& above) {
  below.count = above.count = 0;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec2d p = polygon.corner[static_cast<std::size_t>(i)];
    const Vec2d q = polygon.corner[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double a = along(p, axis), b = along(q, axis);
    if (a <= at) below.add(p);
    if (a >= at) above.add(p);
    if ((a < at && b > at) || (a > at && b < at)) {
      const double t = (at - a) / (b - a);
      const Vec2d cut = axis == 0 ? Vec2d{at, p.y + t * (q.y - p.y)} : Vec2d{p.x + t * (q.x - p.x), at};
      below.add(cut);
      above.add(cut);
    }
  }
}

void TexelCoverage::add(int x, int y, int count, double area) {
  if (area > 0 && count > 0) runs_.push_back({x, y, count, area});
}

/// Range of texels of row y that lie wholly inside a band spanning the row: between the left and the right side's
/// innermost points. A band's corners lie on its upper and lower line, or it has a corner between and the row is not
/// spanned.
void TexelCoverage::wholeTexels(const Polygon& band, int y, int& first, int& end) {
  double left[2] = {1e300, 1e300}, right[2] = {-1e300, -1e300};
  for (int i = 0; i < band.count; ++i) {
    const Vec2d p = band.corner[static_cast<std::size_t>(i)];
    for (int line = 0; line < 2; ++line) {
      if (p.y != y + line) continue;
      left[line] = std::min(left[line], p.x);
      right[line] = std::max(right[line], p.x);
    }
  }
  // Convex: the quadrilateral between the two chords is inside the band.
  const double lo = std::max(left[0], left[1]), hi = std::min(right[0], right[1]);
  if (!(lo < hi)) return;
  first = static_cast<int>(std::ceil(lo));
  end = static_cast<int>(std::floor(hi));
}

void TexelCoverage::coverRow(const Polygon& band, int y, bool fullHeight) {
  int wholeFirst = 0, wholeEnd = 0;
  if (fullHeight) wholeTexels(band, y, wholeFirst, wholeEnd);
  const int last = std::min(width_ - 1, static_cast<int>(std::floor(band.highest(0))));
  Polygon rest = band, piece, beyond;
  for (int x = std::min(last, static_cast<int>(std::floor(band.lowest(0)))); x < last; ++x) {
    const bool run = x >= wholeFirst && x < wholeEnd;
    const int next = run ? std::min(wholeEnd, last) : x + 1;
    split(rest, 0, next, piece, beyond);
    add(x, y, next - x, run ? 1.0 : piece.area());
    std::swap(rest, beyond);
    if (rest.count == 0) return;
    x = next - 1;
  }
  add(last, y, 1, last >= wholeFirst && last < wholeEnd ? 1.0 : rest.area());
}

const std::vector<CoveredRun>& TexelCoverage::of(const std::array<Vec2d, 3>& triangle) {
  runs_.clear();
  Polygon rest, band, beyond;
  for (const Vec2d p : triangle) {
    rest.add({std::clamp(p.x, 0.0, static_cast<double>(width_)), std::clamp(p.y, 0.0, static_cast<double>(height_))});
  }
  const double bottom = rest.lowest(1), top = rest.highest(1);
  const int last = std::min(height_ - 1, static_cast<int>(std::floor(top)));
  for (int y = std::min(last, static_cast<int>(std::floor(bottom))); y <= last; ++y) {
    split(rest, 1, y + 1, band, beyond);
    if (band.count > 0) coverRow(band, y, bottom <= y && top >= y + 1);
    std::swap(rest, beyond);
    if (rest.count == 0) break;
  }
  return runs_;
}

}  // namespace lucarne
