#include "dlm/texel_alpha.h"

#include <algorithm>
#include <cmath>

#include "dlm/plane_polygon.h"
#include "tracer/optics/surface.h"

namespace lucarne {
namespace {

constexpr int kFinest = 16;

/// (b1, b2) of a point; meaningless for a triangle that is a line.
Vec2d barycentricOf(const std::array<Vec2d, 3>& corner, Vec2d p) {
  const Vec2d e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], d = p - corner[0];
  const double inv = 1 / cross2(e1, e2);
  return {cross2(d, e2) * inv, cross2(e1, d) * inv};
}

bool isInside(Vec2d b) { return b.x >= 0 && b.y >= 0 && b.x + b.y <= 1; }

/// Nearest barycentrics of the triangle, roughly: for points a little outside.
Vec2d clampInside(Vec2d b) {
  const double x = std::isfinite(b.x) ? std::clamp(b.x, 0.0, 1.0) : 1.0 / 3;
  const double y = std::isfinite(b.y) ? std::clamp(b.y, 0.0, 1.0 - x) : (1 - x) / 2;
  return {x, y};
}

}  // namespace

TexelAlpha::TexelAlpha(const Scene& scene) : scene_(scene) {
  for (const Material& m : scene.materials) readers_.emplace_back(scene, m.baseColorTexture, Encoding::srgb);
}

double TexelAlpha::at(std::uint32_t triangle, Vec2d b) const {
  const Triangle& t = scene_.triangles[triangle];
  const TextureReader& reader = readers_[t.material];
  Vec2f uv{};
  if (const std::vector<Vec2f>& set = uvOf(reader); reader && !set.empty()) {
    const auto b1 = static_cast<float>(b.x), b2 = static_cast<float>(b.y);
    uv = set[t.v[0]] * (1 - b1 - b2) + set[t.v[1]] * b1 + set[t.v[2]] * b2;
  }
  return static_cast<double>(coverageOf(scene_.materials[t.material], reader, uv, false));
}

/// Pixels of the texture along a texel, from the ratio of areas.
int TexelAlpha::gridSize(std::uint32_t triangle, const std::array<Vec2d, 3>& corner) const {
  const Triangle& t = scene_.triangles[triangle];
  const TextureReader& reader = readers_[t.material];
  const std::vector<Vec2f>& set = uvOf(reader);
  if (!reader || set.empty()) return 1;
  const double area = std::abs(cross2(corner[1] - corner[0], corner[2] - corner[0]));
  const double pixels = reader.pixelArea(set[t.v[1]] - set[t.v[0]], set[t.v[2]] - set[t.v[0]]);
  constexpr double kSamplesAPixel = 4;  // along each axis: masks end between pixels
  return static_cast<int>(std::clamp(std::ceil(kSamplesAPixel * std::sqrt(pixels / std::max(area, 1e-12))), 4.0, double{kFinest}));
}

double TexelAlpha::mean(std::uint32_t triangle, const std::array<Vec2d, 3>& corner, int x, int y) const {
  const int n = gridSize(triangle, corner);
  double sum = 0;
  int inside = 0;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vec2d p{x + (i + 0.5) / n, y + (j + 0.5) / n};
      const Vec2d b = barycentricOf(corner, p);
      if (!isInside(b)) continue;
      sum += at(triangle, b);
      ++inside;
    }
  }
  if (inside > 0) return sum / inside;
  return at(triangle, clampInside(barycentricOf(corner, {x + 0.5, y + 0.5})));
}

}  // namespace lucarne
