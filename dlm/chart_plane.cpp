#include "dlm/chart_plane.h"

#include "dlm/plane_polygon.h"

namespace lucarne {
namespace {

struct Rectangle {
  Vec2d u{1, 0};  // unit, along its first side
  Vec2d lo{}, hi{};
  Vec2d size() const { return hi - lo; }
  double area() const { return size().x * size().y; }
};

Vec2d turned(Vec2d a) { return {-a.y, a.x}; }

Rectangle boundingRectangle(const std::vector<Vec2d>& hull, Vec2d u) {
  Rectangle r{u, {1e300, 1e300}, {-1e300, -1e300}};
  for (const Vec2d p : hull) {
    const Vec2d q{dot(p, u), dot(p, turned(u))};
    r.lo = {std::min(r.lo.x, q.x), std::min(r.lo.y, q.y)};
    r.hi = {std::max(r.hi.x, q.x), std::max(r.hi.y, q.y)};
  }
  return r;
}

/// Rotating calipers (Toussaint 1983): the least rectangle has a side along an edge of the hull. While the edge turns,
/// the furthest points along it, across it and against it only move forward.
class Calipers {
 public:
  explicit Calipers(const std::vector<Vec2d>& hull) : hull_(hull) {}

  Rectangle least() {
    Rectangle best = boundingRectangle(hull_, {1, 0});
    if (hull_.size() < 2) return best;
    // Near ties go to the basis, so that an upright rectangle keeps exact axes.
    double bestArea = best.area() * (1 - 1e-6);
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Vec2d edge = at(i + 1) - at(i);
      const Vec2d u = edge * (1 / std::sqrt(dot(edge, edge)));
      const Rectangle r = along(i, u);
      if (r.area() >= bestArea) continue;
      best = r;
      bestArea = r.area();
    }
    return best;
  }

 private:
  Vec2d at(std::size_t i) const { return hull_[i % hull_.size()]; }

  void advance(std::size_t& i, Vec2d direction) const {
    while (dot(at(i + 1) - at(i), direction) > 0) ++i;
  }

  Rectangle along(std::size_t i, Vec2d u) {
    right_ = std::max(right_, i + 1);
    advance(right_, u);
    top_ = std::max(top_, right_);
    advance(top_, turned(u));
    left_ = std::max(left_, top_);
    advance(left_, {-u.x, -u.y});
    return {u, {dot(at(left_), u), dot(at(i), turned(u))}, {dot(at(right_), u), dot(at(top_), turned(u))}};
  }

  const std::vector<Vec2d>& hull_;
  std::size_t right_ = 0, top_ = 0, left_ = 0;
};

}  // namespace

Vec3d snappedNormal(Vec3d v) {
  const Vec3d n = normalize(v);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(n[i]) < 1 - 1e-12) continue;  // within a millionth of a radian
    Vec3d axis;
    axis[i] = n[i] > 0 ? 1 : -1;
    return axis;
  }
  return n;
}

void planeAxes(Vec3d normal, Vec3d& axisU, Vec3d& axisV) {
  const double level = normal.x * normal.x + normal.z * normal.z;
  if (level < 1e-6) {
    const Frame<double> frame(normal);
    axisU = frame.s;
    axisV = frame.t;
    return;
  }
  axisU = normalize(cross(Vec3d(0, 1, 0), normal));
  axisV = cross(normal, axisU);
}

float clampedInside(double x, double size) {
  float f = static_cast<float>(std::clamp(x, 0.0, size));
  while (static_cast<double>(f) > size) f = std::nextafterf(f, 0.f);
  return f;
}

std::vector<Vec2d> convexHull(std::vector<Vec2d> points) {
  std::sort(points.begin(), points.end(), [](Vec2d a, Vec2d b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2d> hull;  // Andrew's monotone chain: the lower side, then the upper
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Vec2d p : points) {
      while (hull.size() >= start + 2 && orient(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

ChartPlane fitPlane(Vec3d normal, const std::vector<Vec3d>& points, double minSize) {
  Vec3d s, t;
  planeAxes(normal, s, t);
  std::vector<Vec2d> projected;
  projected.reserve(points.size());
  for (const Vec3d p : points) projected.push_back({dot(p, s), dot(p, t)});
  const std::vector<Vec2d> hull = convexHull(std::move(projected));
  Vec2d u = Calipers(hull).least().u;
  const Rectangle r = boundingRectangle(hull, u);
  if (r.size().y > r.size().x) u = turned(u);

  ChartPlane plane{normal, s * u.x + t * u.y, t * u.x - s * u.y, {1e300, 1e300}, {}};
  Vec2d hi{-1e300, -1e300};
  for (const Vec3d p : points) {  // with the final axes, so that no point is outside by rounding
    const Vec2d q{dot(p, plane.axisU), dot(p, plane.axisV)};
    plane.origin = {std::min(plane.origin.x, q.x), std::min(plane.origin.y, q.y)};
    hi = {std::max(hi.x, q.x), std::max(hi.y, q.y)};
  }
  plane.size = {std::max(hi.x - plane.origin.x, minSize), std::max(hi.y - plane.origin.y, minSize)};
  return plane;
}

}  // namespace lucarne
