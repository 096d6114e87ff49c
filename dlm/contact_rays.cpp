#include "dlm/contact_rays.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <unordered_map>

namespace lucarne {
namespace {

// cos 20° times the sine and cosine of 22.5°, and sin 20°.
constexpr double kA = 0.3596040, kB = 0.8681613, kUp = 0.3420201;
constexpr std::array<Vec3d, 9> kDirections = {Vec3d{0, 0, 1},  {kB, kA, kUp},  {kA, kB, kUp},
                                              {-kA, kB, kUp},  {-kB, kA, kUp}, {-kB, -kA, kUp},
                                              {-kA, -kB, kUp}, {kA, -kB, kUp}, {kB, -kA, kUp}};

/// Looks for a sole under a place of a chart.
struct SoleSearch {
  const ContactScene& in;
  std::uint32_t chart;
  Vec3d place, normal;
  double touching, depth;
  bool found = false;

  bool isSole(std::uint32_t t) const {
    const Scene& scene = in.scene;
    if (in.charts.chartOfTriangle[t] == chart || !scene.materials[scene.triangles[t].material].stopsLight())
      return false;
    const Vec3d p0(scene.corner(t, 0)), e1 = Vec3d(scene.corner(t, 1)) - p0, e2 = Vec3d(scene.corner(t, 2)) - p0,
                                        scaled = cross(e1, e2), d = place - p0;
    const double square = dot(scaled, scaled);
    if (!(square > 0) || dot(normalize(scaled), normal) > -0.996) return false;
    const double up = dot(normal, p0 - place);
    const double b1 = dot(cross(d, e2), scaled) / square, b2 = dot(cross(e1, d), scaled) / square;
    return up <= touching && up >= -depth && b1 >= 0 && b2 >= 0 && b1 + b2 <= 1;
  }
  static bool visit(RTCPointQueryFunctionArguments* arguments) {
    SoleSearch& self = *static_cast<SoleSearch*>(arguments->userPtr);
    self.found = self.found || self.isSole(arguments->primID);
    return false;
  }
  bool run() {
    RTCPointQuery query{static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z), 0,
                        static_cast<float>(depth * (1 + 1e-5) + touching)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(in.caster.embreeScene(), &query, &context, &SoleSearch::visit, this);
    return found;
  }
};

/// Casts from places that it finds triangles for.
class Caster {
 public:
  Caster(const ContactScene& in, std::uint32_t chart, bool back)
      : in_(in), layout_(in.layout.charts[chart]), chart_(chart), back_(back), height_(contactHeight(layout_)) {}

  /// Nothing where the triangle does not hold the place.
  RayVotes cast(std::uint32_t triangle, Vec2d st) const {
    std::array<Vec2d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = in_.charts.cornerUv[triangle][k];
      corner[k] = {static_cast<double>(uv.x) * layout_.texelsPerLocal.x,
                   static_cast<double>(uv.y) * layout_.texelsPerLocal.y};
    }
    const Vec2d s1 = corner[1] - corner[0], s2 = corner[2] - corner[0];
    const double inv = 1 / cross2(s1, s2), b1 = cross2(st - corner[0], s2) * inv, b2 = cross2(s1, st - corner[0]) * inv;
    if (!(b1 >= 0 && b2 >= 0 && b1 + b2 <= 1)) return {};
    const Scene& scene = in_.scene;
    const Vec3d p0(scene.corner(triangle, 0)), p1(scene.corner(triangle, 1)), p2(scene.corner(triangle, 2));
    const Vec3d n = normalize(back_ ? -scene.scaledNormal(triangle) : scene.scaledNormal(triangle));
    const Vec3d place = p0 + (p1 - p0) * b1 + (p2 - p0) * b2;
    RayVotes votes = castFrom(place + n * height_, n);
    constexpr double kTexelsUnder = 16;  // heights: one texel
    SoleSearch search{
        in_, chart_, place, n, 4 * static_cast<double>(in_.caster.clearance(triangle)), kTexelsUnder * height_};
    if (votes.backs > 0 && search.run()) votes.soles = votes.rays;
    return votes;
  }

 private:
  RayVotes castFrom(Vec3d origin, Vec3d n) const {
    RayVotes votes;
    const Frame<double> frame(n);
    for (const Vec3d& d : kDirections) {
      ++votes.rays;
      countBack(Vec3f(origin), normalize(Vec3f(frame.toWorld(d))), votes);
    }
    return votes;
  }

  void countBack(Vec3f origin, Vec3f direction, RayVotes& votes) const {
    std::uint64_t repeats = 0;
    const std::uint32_t met = in_.caster.nearest(origin, direction, kNone, repeats);
    if (met == kNone) return;
    const Material& m = in_.scene.materials[in_.scene.triangles[met].material];
    if (!m.stopsLight() || !in_.caster.intersect(met, origin, direction).back) return;
    ++votes.backs;
    votes.blackBacks += m.doubleSided ? 0 : 1;
  }

  const ContactScene& in_;
  const ChartLayout& layout_;
  std::uint32_t chart_;
  bool back_;
  double height_;
};

}  // namespace

std::vector<RayVotes> castFromChart(const ContactScene& in, std::uint32_t chart, bool back,
                                    const std::vector<Vec2d>& places) {
  const ChartLayout& layout = in.layout.charts[chart];
  const Caster caster(in, chart, back);
  std::vector<RayVotes> votes(places.size());
  std::unordered_multimap<std::uint64_t, std::size_t> byTexel;
  const auto texel = [&layout](int x, int y) {
    return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(layout.width) + static_cast<std::uint64_t>(x);
  };
  for (std::size_t i = 0; i < places.size(); ++i)
    byTexel.emplace(texel(static_cast<int>(places[i].x), static_cast<int>(places[i].y)), i);
  const auto look = [&](std::uint32_t triangle, std::size_t i) {
    if (votes[i].rays == 0) votes[i] = caster.cast(triangle, places[i]);
  };
  for (const std::uint32_t t : in.charts.charts[chart].triangles) {
    int x0 = layout.width, y0 = layout.height, x1 = 0, y1 = 0;
    for (const Vec2f uv : in.charts.cornerUv[t]) {
      const TexelIndex at = texelAt(layout, {static_cast<float>(static_cast<double>(uv.x) * layout.texelsPerLocal.x),
                                             static_cast<float>(static_cast<double>(uv.y) * layout.texelsPerLocal.y)});
      x0 = std::min(x0, at.x), x1 = std::max(x1, at.x), y0 = std::min(y0, at.y), y1 = std::max(y1, at.y);
    }
    const auto box = static_cast<std::uint64_t>(x1 - x0 + 1) * static_cast<std::uint64_t>(y1 - y0 + 1);
    if (box >= places.size()) {
      for (std::size_t i = 0; i < places.size(); ++i) look(t, i);
      continue;
    }
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (auto [i, end] = byTexel.equal_range(texel(x, y)); i != end; ++i) look(t, i->second);
  }
  return votes;
}

}  // namespace lucarne
