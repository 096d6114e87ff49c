#include "dlm/texel_gather.h"

#include <cmath>

#include "base/float_mode.h"

namespace lucarne {
namespace {

struct Polygon {
  std::array<Vec2d, 7> corner;
  std::size_t count = 0;
  void add(Vec2d p) { corner[count++] = p; }
};

double cross2(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }

/// The part where sign·(p[axis] − at) ≥ 0 (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& in, bool yAxis, double at, double sign) {
  Polygon out;
  const auto height = [&](Vec2d p) { return sign * ((yAxis ? p.y : p.x) - at); };
  for (std::size_t i = 0; i < in.count; ++i) {
    const Vec2d a = in.corner[i], b = in.corner[(i + 1) % in.count];
    const double ha = height(a), hb = height(b);
    if (ha >= 0) out.add(a);
    if ((ha >= 0) != (hb >= 0)) out.add(a + (b - a) * (ha / (ha - hb)));
  }
  return out;
}

/// A triangle of a piece of surface inside one texel.
struct Piece {
  std::uint32_t triangle;
  std::array<Vec2d, 3> st;
  double weight;  // k · surface area, local
};

/// The surface that the kernel about one texel reaches.
class KernelSurface {
 public:
  KernelSurface(const GatherScene& in, const TallySide& side, int x, int y, const Kernel& kernel)
      : in_(in),
        chart_(in.charts.charts[side.chart]),
        layout_(in.layout.charts[side.chart]),
        kernel_(kernel),
        x_(x),
        y_(y) {
    for (const std::uint32_t t : chart_.triangles) addTriangle(t);
    forTexels([&](int u, int v, double k) {
      const auto at = layout_.firstTexel + static_cast<std::uint64_t>(v) * static_cast<std::uint64_t>(layout_.width) +
                      static_cast<std::uint64_t>(u);
      kernelArea_ += k * in_.layout.area[at];
    });
  }

  bool empty() const { return pieces_.empty() || !(kernelArea_ > 0); }
  /// Σ k·surface over Σ k·area: what a sample of E·α is multiplied with.
  double scale() const { return cumulative_.back() / kernelArea_; }

  struct Place {
    std::uint32_t triangle;
    Vec2f b;
  };
  Place sample(double pick, Vec2f u) const {
    const auto at = std::upper_bound(cumulative_.begin(), cumulative_.end(), pick * cumulative_.back());
    const Piece& p = pieces_[std::min(static_cast<std::size_t>(at - cumulative_.begin()), pieces_.size() - 1)];
    const Vec2f w = sampleTriangle(u);
    const Vec2d st =
        p.st[0] + (p.st[1] - p.st[0]) * static_cast<double>(w.x) + (p.st[2] - p.st[0]) * static_cast<double>(w.y);
    const std::array<Vec2d, 3> c = corners(p.triangle);
    const Vec2d e1 = c[1] - c[0], e2 = c[2] - c[0], d = st - c[0];
    const double inv = 1 / cross2(e1, e2);
    const double b1 = std::clamp(cross2(d, e2) * inv, 0.0, 1.0), b2 = std::clamp(cross2(e1, d) * inv, 0.0, 1 - b1);
    return {p.triangle, {static_cast<float>(b1), static_cast<float>(b2)}};
  }

 private:
  std::array<Vec2d, 3> corners(std::uint32_t t) const {
    std::array<Vec2d, 3> st;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2f uv = in_.charts.cornerUv[t][k];
      st[k] = {uv.x * layout_.texelsPerLocal.x, uv.y * layout_.texelsPerLocal.y};
    }
    return st;
  }

  template <class F>
  void forTexels(F&& f) const {
    const int r = kernel_.radius;
    for (int v = std::max(0, y_ - r); v <= std::min(layout_.height - 1, y_ + r); ++v)
      for (int u = std::max(0, x_ - r); u <= std::min(layout_.width - 1, x_ + r); ++u)
        f(u, v, kernel_(u - x_) * kernel_(v - y_));
  }

  void addTriangle(std::uint32_t t) {
    const std::array<Vec2d, 3> st = corners(t);
    const double projected = std::abs(cross2(st[1] - st[0], st[2] - st[0]));
    if (!(projected > 0)) return;
    const double surface = length(in_.scene.scene().scaledNormal(t)) / projected;  // local² a texel²
    Polygon whole;
    for (const Vec2d& p : st) whole.add(p);
    forTexels([&](int u, int v, double k) {
      Polygon p = clip(clip(whole, false, u, 1), false, u + 1, -1);
      p = clip(clip(p, true, v, 1), true, v + 1, -1);
      for (std::size_t i = 2; i < p.count; ++i) addPiece(t, {p.corner[0], p.corner[i - 1], p.corner[i]}, k * surface);
    });
  }

  void addPiece(std::uint32_t t, const std::array<Vec2d, 3>& st, double weight) {
    const double w = 0.5 * std::abs(cross2(st[1] - st[0], st[2] - st[0])) * weight;
    if (!(w > 0)) return;
    pieces_.push_back({t, st, w});
    cumulative_.push_back((cumulative_.empty() ? 0 : cumulative_.back()) + w);
  }

  const GatherScene& in_;
  const Chart& chart_;
  const ChartLayout& layout_;
  const Kernel& kernel_;
  int x_, y_;
  double kernelArea_ = 0;
  std::vector<Piece> pieces_;
  std::vector<double> cumulative_;
};

class Moments {
 public:
  void add(double x) {
    sum_ += x;
    squares_ += x * x;
  }
  GatherValue over(std::uint64_t samples) const {
    const auto n = static_cast<double>(samples);
    const double mean = sum_ / n, variance = std::max(0.0, squares_ / n - mean * mean);
    return {mean, std::sqrt(variance / std::max(1.0, n - 1))};
  }

 private:
  double sum_ = 0, squares_ = 0;
};

}  // namespace

TexelGatherResult gatherTexel(const GatherScene& in, std::uint32_t sideIndex, int x, int y,
                              const KernelOptions& options, LightPart part, std::uint64_t samples, std::uint64_t seed) {
  const FlushDenormals mode;
  const TallySide& side = in.tallies.sides[sideIndex];
  const MemberSet& members = in.tallies.membersOf(side);
  const Kernel kernel = makeKernel(options);
  const KernelSurface surface(in, side, x, y, kernel);
  TexelGatherResult result;
  result.byRank.resize(members.mapCount());
  if (surface.empty()) return result;
  result.covered = true;
  const PathTracer paths(in.scene);
  std::vector<Moments> moments(members.mapCount());
  std::vector<double> shares(members.mapCount());
  Moments whole;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const PhotonSampler sampler(seed, i);
    const auto w = sampler.words(0, Stream::place);
    const auto place = surface.sample(toUnitDouble(w[0], w[1]), {toUnitFloat(w[2]), toUnitFloat(w[3])});
    const Receiver at = receiverAt(in.scene, place.triangle, place.b, side.back);
    const double there =
        static_cast<double>(in.scene.surfaces().coverage(placeOf(at.hit), side.back)) * surface.scale();
    std::fill(shares.begin(), shares.end(), 0.0);
    double sum = 0;
    const ReceivedLight light = paths.receive(at, sampler);
    for (std::size_t k = 0; k < light.count; ++k) {
      const ReceivedLight::Piece& piece = light.pieces[k];
      if (part != LightPart::all && (part == LightPart::direct) != piece.direct) continue;
      const Rgbd lux = Rgbd(piece.lux) * there;
      const std::size_t rank =
          members.members.empty() ? 0 : members.rank[static_cast<std::size_t>(in.directions.nearest(piece.wi))];
      result.irradiance += lux;
      shares[rank] += luminance(lux);
      sum += luminance(lux);
    }
    whole.add(sum);
    for (std::size_t r = 0; r < shares.size(); ++r) moments[r].add(shares[r]);
  }
  result.irradiance = result.irradiance / static_cast<double>(samples);
  result.luminance = whole.over(samples);
  for (std::size_t r = 0; r < shares.size(); ++r) result.byRank[r] = moments[r].over(samples);
  return result;
}

}  // namespace lucarne
