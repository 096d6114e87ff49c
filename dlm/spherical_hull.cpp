// Incremental convex hull (Clarkson and Shor 1989, without the conflict graph): each point takes away the triangles
// that it sees from outside, which hang together, and closes the hole with a fan.
#include "dlm/spherical_hull.h"

#include <algorithm>

#include "base/error.h"

namespace lucarne {

namespace {

// A point sees a triangle from above by more than rounding: four times the volume of the tetrahedron is some 1e-7 for
// neighbours among 65535 points, and rounding some 1e-16. Without it points on one circle could be torn apart.
constexpr double kLeastVolume = 1e-13;

class Hull {
 public:
  explicit Hull(std::span<const Vec3d> points) : points_(points), faceFrom_(points.size()), used_(points.size()) {
    begin();
    for (std::uint32_t p = 0; p < points_.size(); ++p)
      if (!used_[p]) insert(p);
  }

  std::vector<HullTriangle> triangles() const {
    std::vector<std::uint32_t> place(faces_.size());
    std::vector<HullTriangle> all;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      place[f] = static_cast<std::uint32_t>(all.size());
      if (alive_[f]) all.push_back(faces_[f]);
    }
    for (HullTriangle& t : all)
      for (std::uint32_t& other : t.across) other = place[other];
    return all;
  }

 private:
  double volume(const std::array<std::uint32_t, 3>& v, std::uint32_t p) const {
    const Vec3d a = points_[v[0]];
    return dot(cross(points_[v[1]] - a, points_[v[2]] - a), points_[p] - a);
  }
  bool sees(std::uint32_t p, std::size_t face) const { return volume(faces_[face].v, p) > kLeastVolume; }

  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    faces_.push_back({{a, b, c}, {}});
    alive_.push_back(true);
    return static_cast<std::uint32_t>(faces_.size() - 1);
  }

  template <class F>
  std::uint32_t largest(const F& measure) const {
    std::uint32_t best = 0;
    for (std::uint32_t p = 1; p < points_.size(); ++p)
      if (measure(p) > measure(best)) best = p;
    return best;
  }

  // A tetrahedron as fat as can be had by taking one corner after the other.
  void begin() {
    const Vec3d a = points_[0];
    const std::uint32_t b = largest([&](std::uint32_t p) { return length(points_[p] - a); });
    const std::uint32_t c = largest([&](std::uint32_t p) { return length(cross(points_[b] - a, points_[p] - a)); });
    const std::uint32_t d = largest([&](std::uint32_t p) { return std::abs(volume({0, b, c}, p)); });
    std::array<std::uint32_t, 4> v{0, b, c, d};
    LUCARNE_CHECK_LT(kLeastVolume, std::abs(volume({0, b, c}, d)));
    if (volume({0, b, c}, d) > 0) std::swap(v[1], v[2]);  // d lies below a, b, c
    add(v[0], v[1], v[2]);
    add(v[0], v[3], v[1]);
    add(v[1], v[3], v[2]);
    add(v[2], v[3], v[0]);
    for (HullTriangle& t : faces_) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::uint32_t other = 0; other < 4; ++other) {
          const auto& o = faces_[other].v;
          if (std::find(o.begin(), o.end(), t.v[k]) == o.end()) t.across[k] = other;
        }
      }
    }
    for (const std::uint32_t p : v) used_[p] = true;
  }

  // Points that follow each other in Ω are not neighbours, but a recent one is near: the newest triangles are asked
  // first.
  std::uint32_t seenFrom(std::uint32_t p) const {
    std::size_t f = faces_.size();
    while (f > 0 && !(alive_[f - 1] && sees(p, f - 1))) --f;
    LUCARNE_CHECK_LT(std::size_t{0}, f);
    return static_cast<std::uint32_t>(f - 1);
  }

  struct Edge {
    std::uint32_t a, b, beyond;  // counter-clockwise for the triangle that went; the one that stays
  };

  // Takes away what p sees; what is left ends at these edges.
  std::vector<Edge> takeAway(std::uint32_t p) {
    std::vector<std::uint32_t> open{seenFrom(p)};
    std::vector<Edge> rim;
    alive_[open[0]] = false;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const HullTriangle t = faces_[open[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = t.across[k];
        if (!alive_[other]) continue;
        if (sees(p, other)) {
          alive_[other] = false;
          open.push_back(other);
        } else {
          rim.push_back({t.v[(k + 1) % 3], t.v[(k + 2) % 3], other});
        }
      }
    }
    return rim;
  }

  void insert(std::uint32_t p) {
    used_[p] = true;
    const std::vector<Edge> rim = takeAway(p);
    const auto first = static_cast<std::uint32_t>(faces_.size());
    for (const Edge& e : rim) {
      const std::uint32_t f = add(e.a, e.b, p);
      faces_[f].across[2] = e.beyond;
      HullTriangle& beyond = faces_[e.beyond];
      for (std::size_t k = 0; k < 3; ++k)
        if (beyond.v[(k + 1) % 3] == e.b && beyond.v[(k + 2) % 3] == e.a) beyond.across[k] = f;
      faceFrom_[e.a] = f;
    }
    for (std::uint32_t f = first; f < faces_.size(); ++f) {
      const std::uint32_t next = faceFrom_[faces_[f].v[1]];
      LUCARNE_CHECK_EQ(faces_[next].v[0], faces_[f].v[1]);
      faces_[f].across[0] = next;
      faces_[next].across[1] = f;
    }
  }

  std::span<const Vec3d> points_;
  std::vector<HullTriangle> faces_;  // those that went, too
  std::vector<bool> alive_;
  std::vector<std::uint32_t> faceFrom_;  // by point: the newest triangle that begins with it
  std::vector<bool> used_;
};

}  // namespace

std::vector<HullTriangle> sphericalHull(std::span<const Vec3d> points) {
  LUCARNE_CHECK_LE(std::size_t{4}, points.size());
  std::vector<HullTriangle> triangles = Hull(points).triangles();
  LUCARNE_CHECK_EQ(triangles.size(), 2 * points.size() - 4);  // Euler: no hole, no fold
  return triangles;
}

}  // namespace lucarne
