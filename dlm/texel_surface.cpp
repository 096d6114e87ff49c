#include "dlm/texel_surface.h"

#include <algorithm>
#include <cmath>

#include "dlm/plane_polygon.h"
#include "tracer/optics/warp.h"

namespace lucarne {
namespace {

using Polygon = PlanePolygon;

/// The part where sign·(p[axis] − at) ≥ 0.
Polygon clip(const Polygon& in, bool yAxis, double at, double sign) {
  return clipped(in, [&](Vec2d p) { return sign * ((yAxis ? p.y : p.x) - at); });
}

/// Texels that an interval touches, within [first, end).
struct Span {
  int first, end;
};
Span touched(const Polygon& p, bool yAxis, int first, int end) {
  double lowest = 1e300, highest = -1e300;
  for (std::size_t i = 0; i < p.count; ++i) {
    const double v = yAxis ? p.corner[i].y : p.corner[i].x;
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  const auto clamped = [&](double v) { return static_cast<int>(std::floor(std::clamp(v, first - 1.0, end + 1.0))); };
  return {std::max(first, clamped(lowest)), std::min(end, clamped(highest) + 1)};
}

/// Clips triangles and keeps what is inside texels, in the order of the triangles.
class Clipper {
 public:
  struct Found {
    std::size_t texel;
    SurfacePiece piece;
  };

  Clipper(const Scene& scene, const ChartSet& charts, const TexelLayout& layout, const TexelTile& tile)
      : scene_(scene), charts_(charts), scale_(layout.charts[tile.chart].texelsPerLocal), tile_(tile) {
    for (const std::uint32_t t : charts.charts[tile.chart].triangles) addTriangle(t);
  }
  std::vector<Found> found;

 private:
  void addTriangle(std::uint32_t t) {
    Polygon whole;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = charts_.cornerUv[t][k];
      whole.add({static_cast<double>(uv.x) * scale_.x, static_cast<double>(uv.y) * scale_.y});
    }
    const Span rows = touched(whole, true, tile_.y, tile_.y + tile_.height);
    const Span columns = touched(whole, false, tile_.x, tile_.x + tile_.width);
    if (rows.first >= rows.end || columns.first >= columns.end) return;
    corner_ = {whole.corner[0], whole.corner[1], whole.corner[2]};
    const double twice = cross2(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    const double surface = 0.5 * length(scene_.scaledNormal(t));
    if (!(std::abs(twice) > 0)) return addPoint(t, surface);
    inverse_ = 1 / twice;
    density_ = surface / (0.5 * std::abs(twice));
    for (int y = rows.first; y < rows.end; ++y) {
      const Polygon row = clip(clip(whole, true, y, 1), true, y + 1, -1);
      if (row.count < 3) continue;
      const Span here = touched(row, false, tile_.x, tile_.x + tile_.width);
      for (int x = here.first; x < here.end; ++x) addPolygon(t, x, y, clip(clip(row, false, x, 1), false, x + 1, -1));
    }
  }

  /// Rounding left a line: all of it is where its middle is, as in the layout's areas.
  void addPoint(std::uint32_t t, double surface) {
    const Vec2d middle = (corner_[0] + corner_[1] + corner_[2]) * (1.0 / 3);
    const int x = static_cast<int>(std::floor(middle.x)), y = static_cast<int>(std::floor(middle.y));
    if (x < tile_.x || x >= tile_.x + tile_.width || y < tile_.y || y >= tile_.y + tile_.height) return;
    const Vec2f b{1.f / 3, 1.f / 3};
    add(t, x, y, {b, b, b}, surface);
  }

  void addPolygon(std::uint32_t t, int x, int y, const Polygon& p) {
    for (std::size_t i = 2; i < p.count; ++i) {
      const Vec2d e1 = p.corner[i - 1] - p.corner[0], e2 = p.corner[i] - p.corner[0];
      add(t, x, y, {barycentric(p.corner[0]), barycentric(p.corner[i - 1]), barycentric(p.corner[i])},
          0.5 * std::abs(cross2(e1, e2)) * density_);
    }
  }

  void add(std::uint32_t t, int x, int y, const std::array<Vec2f, 3>& b, double surface) {
    if (!(surface > 0)) return;
    const auto texel = static_cast<std::size_t>(y - tile_.y) * static_cast<std::size_t>(tile_.width) +
                       static_cast<std::size_t>(x - tile_.x);
    found.push_back({texel, {t, b, surface}});
  }

  Vec2f barycentric(Vec2d p) const {
    const Vec2d d = p - corner_[0];
    const double b1 = std::clamp(cross2(d, corner_[2] - corner_[0]) * inverse_, 0.0, 1.0);
    const double b2 = std::clamp(cross2(corner_[1] - corner_[0], d) * inverse_, 0.0, 1 - b1);
    return {static_cast<float>(b1), static_cast<float>(b2)};
  }

  const Scene& scene_;
  const ChartSet& charts_;
  Vec2d scale_;
  const TexelTile& tile_;
  std::array<Vec2d, 3> corner_{};
  double inverse_ = 0, density_ = 0;  // local units² a texel²
};

}  // namespace

TexelSurface::TexelSurface(const Scene& scene, const ChartSet& charts, const TexelLayout& layout,
                           const TexelTile& tile) {
  const Clipper clipper(scene, charts, layout, tile);
  first_.assign(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height) + 1, 0);
  for (const Clipper::Found& f : clipper.found) ++first_[f.texel + 1];
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  pieces_.resize(clipper.found.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const Clipper::Found& f : clipper.found) {
    const std::size_t at = next[f.texel]++;
    const double below = at == first_[f.texel] ? 0 : pieces_[at - 1].upTo;
    pieces_[at] = {f.piece.triangle, f.piece.b, below + f.piece.upTo};
  }
}

TexelPlace TexelSurface::sample(std::size_t t, Vec3f u) const {
  const auto begin = pieces_.begin() + static_cast<std::ptrdiff_t>(first_[t]),
             end = pieces_.begin() + static_cast<std::ptrdiff_t>(first_[t + 1]);
  const double wanted = static_cast<double>(u.x) * area(t);
  const auto at = std::upper_bound(begin, end - 1, wanted, [](double w, const SurfacePiece& p) { return w < p.upTo; });
  const Vec2f w = sampleTriangle({u.y, u.z});
  return {at->triangle, at->b[0] + (at->b[1] - at->b[0]) * w.x + (at->b[2] - at->b[0]) * w.y};
}

}  // namespace lucarne
