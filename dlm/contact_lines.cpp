#include "dlm/contact_lines.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>

#include "tracer/scene/scene_cleanup.h"

namespace lucarne {
namespace {

constexpr double kLineHeight = 1.0 / 16, kCoverHeight = 1.0 / 4;  // texels
constexpr double kSteep = 0.5, kParallel = 0.9962;                // cosines between the normals
constexpr double kOverlap = 1e-3;  // texels that pieces reach beyond their ends, so that no crack is left between them
constexpr int kCell = 16;          // texels along the edge of what is searched at once

double texelOf(const ChartLayout& layout) { return 1 / std::sqrt(layout.texelsPerLocal.x * layout.texelsPerLocal.y); }

/// The part of a line in a counter-clockwise polygon or within the overlap of it (Cyrus and Beck 1978); empty: a == b.
ContactLine clipLine(ContactLine line, const PlanePolygon& polygon) {
  double first = 0, last = 1;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec2d a = polygon.corner[i], edge = polygon.corner[(i + 1) % polygon.count] - a;
    const double slack = kOverlap * std::hypot(edge.x, edge.y);
    const double from = cross2(edge, line.a - a) + slack, to = cross2(edge, line.b - a) + slack;
    if (from < 0 && to < 0) return {};
    if (from < 0) first = std::max(first, from / (from - to));
    if (to < 0) last = std::min(last, from / (from - to));
  }
  if (!(first < last)) return {};
  const Vec2d d = line.b - line.a;
  return {line.a + d * first, line.a + d * last};
}

ContactLine extended(ContactLine line) {
  const Vec2d d = line.b - line.a;
  const double length = std::hypot(d.x, d.y);
  if (!(length > 0)) return line;
  const Vec2d more = d * (kOverlap / length);
  return {line.a - more, line.b + more};
}

}  // namespace

double contactHeight(const ChartLayout& layout) { return kLineHeight * texelOf(layout); }

/// A triangle of the chart inside one cell of texels, and what is near it.
class ContactFinder::Piece {
 public:
  Piece(const ContactFinder& finder, std::uint32_t triangle, bool back, SideLines& found)
      : finder_(finder), found_(found), chart_(finder.charts_.chartOfTriangle[triangle]) {
    const Scene& scene = finder.scene_;
    const ChartLayout& layout = finder.layout_.charts[chart_];
    for (int k = 0; k < 3; ++k) {
      const Vec2f uv = finder.charts_.cornerUv[triangle][static_cast<std::size_t>(k)];
      whole_.add(
          {static_cast<double>(uv.x) * layout.texelsPerLocal.x, static_cast<double>(uv.y) * layout.texelsPerLocal.y});
    }
    origin_ = Vec3d(scene.corner(triangle, 0));
    e1_ = Vec3d(scene.corner(triangle, 1)) - origin_;
    e2_ = Vec3d(scene.corner(triangle, 2)) - origin_;
    scaled_ = cross(e1_, e2_);
    inverse_ = 1 / dot(scaled_, scaled_);
    normal_ = normalize(back ? -scaled_ : scaled_);
    texel_ = texelOf(layout);
    touching_ = 4 * static_cast<double>(finder.caster_.clearance(triangle));
  }

  void run() {
    if (!(std::abs(whole_.signedArea()) > 0) || !std::isfinite(inverse_)) return;
    Vec2d lo = whole_.corner[0], hi = lo;
    for (const Vec2d p : {whole_.corner[1], whole_.corner[2]}) {
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
    for (double y = std::floor(lo.y / kCell) * kCell; y < hi.y; y += kCell) {
      const PlanePolygon row =
          clipped(clipped(whole_, [y](Vec2d p) { return p.y - y; }), [y](Vec2d p) { return y + kCell - p.y; });
      for (double x = std::floor(lo.x / kCell) * kCell; row.count > 2 && x < hi.x; x += kCell) {
        polygon_ = counterClockwise(
            clipped(clipped(row, [x](Vec2d p) { return p.x - x; }), [x](Vec2d p) { return x + kCell - p.x; }));
        if (polygon_.count > 2) search();
      }
    }
  }

 private:
  /// The place over which a point is.
  Vec2d placeOf(Vec3d p) const {
    const Vec3d d = p - origin_;
    return whole_.corner[0] + (whole_.corner[1] - whole_.corner[0]) * (dot(cross(d, e2_), scaled_) * inverse_) +
           (whole_.corner[2] - whole_.corner[0]) * (dot(cross(e1_, d), scaled_) * inverse_);
  }
  Vec3d pointAt(Vec2d st) const {
    const Vec2d s1 = whole_.corner[1] - whole_.corner[0], s2 = whole_.corner[2] - whole_.corner[0],
                d = st - whole_.corner[0];
    const double inv = 1 / cross2(s1, s2);
    return origin_ + e1_ * (cross2(d, s2) * inv) + e2_ * (cross2(s1, d) * inv);
  }

  void search() {
    Vec3d centre;
    for (std::size_t i = 0; i < polygon_.count; ++i)
      centre += pointAt(polygon_.corner[i]) / static_cast<double>(polygon_.count);
    double radius = 0;
    for (std::size_t i = 0; i < polygon_.count; ++i)
      radius = std::max(radius, length(pointAt(polygon_.corner[i]) - centre));
    RTCPointQuery query{static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z), 0,
                        static_cast<float>((radius + kCoverHeight * texel_) * (1 + 1e-5) + 1e-6)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(finder_.caster_.embreeScene(), &query, &context, &Piece::visit, this);
  }

  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    static_cast<Piece*>(arguments->userPtr)->look(arguments->primID);
    return false;  // the radius stays
  }

  void look(std::uint32_t other) {
    const Scene& scene = finder_.scene_;
    if (finder_.stops_[other] == 0 || finder_.charts_.chartOfTriangle[other] == chart_) return;
    std::array<Vec3d, 3> corner;
    std::array<double, 3> height{};
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = Vec3d(scene.corner(other, static_cast<int>(k)));
      height[k] = dot(normal_, corner[k] - origin_);
    }
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    if (!(*high > touching_ && *low < kCoverHeight * texel_)) return;
    const double facing = std::abs(dot(normal_, normalize(scene.scaledNormal(other))));
    if (facing <= kSteep) {
      addLine(corner, height, std::max(kLineHeight * texel_, touching_));
    } else if (facing >= kParallel) {
      addCover(corner, height);
    }
  }

  void addLine(const std::array<Vec3d, 3>& corner, const std::array<double, 3>& height, double level) {
    std::array<Vec2d, 2> end;
    std::size_t ends = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = height[k] - level, b = height[(k + 1) % 3] - level;
      if ((a < 0) == (b < 0) || ends == 2) continue;
      end[ends++] = placeOf(corner[k] + (corner[(k + 1) % 3] - corner[k]) * (a / (a - b)));
    }
    if (ends < 2) return;
    const ContactLine line = clipLine(extended({end[0], end[1]}), polygon_);
    if (!(line.a == line.b)) found_.lines.push_back(line);
  }

  /// Over the chart's triangle the height of a parallel one is an affine function of the place.
  void addCover(const std::array<Vec3d, 3>& corner, const std::array<double, 3>& height) {
    PlanePolygon cover;
    for (const Vec3d& p : corner) cover.add(placeOf(p));
    const Vec2d s1 = cover.corner[1] - cover.corner[0], s2 = cover.corner[2] - cover.corner[0], at = cover.corner[0];
    const double inv = 1 / cross2(s1, s2), h1 = height[1] - height[0], h2 = height[2] - height[0];
    if (!std::isfinite(inv)) return;
    const auto heightAt = [&](Vec2d p) {
      return height[0] + h1 * (cross2(p - at, s2) * inv) + h2 * (cross2(s1, p - at) * inv);
    };
    cover = clipped(clipped(cover, [&](Vec2d p) { return heightAt(p) - touching_; }),
                    [&](Vec2d p) { return kCoverHeight * texel_ - heightAt(p); });
    for (std::size_t i = 0; i < polygon_.count; ++i) {
      const Vec2d a = polygon_.corner[i], edge = polygon_.corner[(i + 1) % polygon_.count] - a;
      const double slack = kOverlap * std::hypot(edge.x, edge.y);
      cover = clipped(cover, [&](Vec2d p) { return cross2(edge, p - a) + slack; });
    }
    cover = counterClockwise(cover);
    if (cover.count > 2 && cover.signedArea() > 1e-9) found_.covers.push_back(cover);
  }

  const ContactFinder& finder_;
  SideLines& found_;
  std::uint32_t chart_;
  PlanePolygon whole_, polygon_;  // texel coordinates: of the triangle, and of the part in the cell
  Vec3d origin_, e1_, e2_, scaled_, normal_;
  double inverse_ = 0, texel_ = 0, touching_ = 0;  // touching_: heights that count as in the plane
};

ContactFinder::ContactFinder(const Scene& scene, const ChartSet& charts, const TexelLayout& layout,
                             const RayCaster& caster)
    : scene_(scene), charts_(charts), layout_(layout), caster_(caster), stops_(scene.triangles.size()) {
  for (std::uint32_t t = 0; t < stops_.size(); ++t)
    stops_[t] = !isSkipped(scene, t) && scene.materials[scene.triangles[t].material].stopsLight() ? 1 : 0;
}

SideLines ContactFinder::find(std::uint32_t chart, bool back) const {
  SideLines found;
  for (const std::uint32_t t : charts_.charts[chart].triangles) Piece(*this, t, back, found).run();
  return found;
}

}  // namespace lucarne
