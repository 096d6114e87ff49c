#include "tracer/optics/glass_albedo.h"

#include <cmath>

#include "base/math.h"
#include "tracer/optics/dielectric.h"
#include "tracer/optics/ggx.h"

namespace lucarne {
/// Newton's iteration on the Legendre polynomial, from the asymptotic roots.
GaussRule::GaussRule(int n) : x(static_cast<std::size_t>(n)), weight(x) {
  for (int i = 0; i < n; ++i) {
    double z = -cosPi((i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    x[static_cast<std::size_t>(i)] = static_cast<float>(0.5 + 0.5 * z);
    weight[static_cast<std::size_t>(i)] = static_cast<float>(1 / ((1 - z * z) * slope * slope));
  }
}

namespace {

/// A stretch of a variable of integration. Where the integrand has a root at an end, the substitution flattens it.
struct Span {
  float from, to;
  bool rootAtFrom = false, rootAtTo = false;

  /// Calls f(value, weight) for the points of the rule.
  template <class F>
  void integrate(const GaussRule& rule, F&& f) const {
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const float s = rule.x[i], r = 1 - s;
      float t = s, dt = 1;
      if (rootAtFrom && rootAtTo) {
        t = s * s * (3 - 2 * s);
        dt = 6 * s * r;
      } else if (rootAtFrom) {
        t = s * s;
        dt = 2 * s;
      } else if (rootAtTo) {
        t = 1 - r * r;
        dt = 2 * r;
      }
      f(from + (to - from) * t, (to - from) * dt * rule.weight[i]);
    }
  }
};

constexpr float kEnd = 1.f - 1e-6f;  // half tangents of slopes that no facet has

/// tan(arctan(t)/2), the substitution that covers a line with (−1, 1).
float halfTangent(float t) { return std::clamp(t / (1.f + std::sqrt(1.f + t * t)), -kEnd, kEnd); }

/// The light from one direction at one roughness. Facets are named by their slopes, h = (x, y, 1)/√(1 + x² + y²).
struct Incidence {
  float eta;
  bool thin;
  float alpha;
  Vec3f w;
  float lambda;

  /// What goes on from one facet: G2/G1 (see sample() of glass.cpp), split by Fresnel.
  Vec3f shares(float x, float y) const {
    const float hz = 1.f / std::sqrt(1.f + x * x + y * y), cosI = (w.z + w.x * x) * hz;
    const Refraction r = refraction(cosI, eta);
    const float up = 2.f * cosI * hz - w.z;
    const float mirrored = up > 0 ? (1.f + lambda) / (1.f + lambda + ggxLambda(up, alpha)) : 0.f;
    if (r.total) return {0, mirrored, 0};
    if (thin) return {mirrored * r.fresnel, 0, mirrored * (1.f - r.fresnel)};
    const float down = reflectsAll(eta) ? 0.f : (w.z - hz * cosI) / eta + hz * r.cosT;
    const float refracted = down > 0 ? ggxG1(down, alpha) : 0.f;
    return {mirrored * r.fresnel, 0, refracted * (1.f - r.fresnel)};
  }
};

/// Where the integrand has edges, for the slopes of one incidence: where total reflection begins, w·h = cos θc, and
/// where the reflected direction passes the horizon.
class Edges {
 public:
  explicit Edges(const Incidence& in) : w_(in.w), alpha_(in.alpha), sine_(in.eta) {
    critical_ = !reflectsAll(in.eta) && in.eta < 1;
    if (critical_) cosine_ = std::sqrt((1.f - in.eta) * (1.f + in.eta));
  }

  /// Stretches of x, as half tangents of x/α. In the plane of w (at angle θ) facets seen from it, w·h > 0, begin at the
  /// angle θ − 90°; those at (θ − 90°)/2 reflect along the surface; the critical ones are at θ ± θc.
  std::vector<Span> rows() const {
    const float begin = w_.x > 0 ? slope(-w_.z, w_.x) : -kEnd;
    const float c = std::sqrt(0.5f + 0.5f * w_.z), s = std::sqrt(std::max(0.f, 0.5f - 0.5f * w_.z));
    const float horizon = slope(s - c, s + c);
    std::vector<Span> spans{{begin, kEnd}};
    if (critical_) {
      const float low = slope(w_.x * cosine_ - w_.z * sine_, w_.z * cosine_ + w_.x * sine_);
      const float high = slope(w_.x * cosine_ + w_.z * sine_, w_.z * cosine_ - w_.x * sine_);
      spans = {{begin, low}, {low, high, true, high < kEnd}, {high, kEnd}};
    }
    for (std::size_t i = 0; i < spans.size(); ++i) {
      if (horizon <= spans[i].from || horizon >= spans[i].to) continue;
      const Span rest{horizon, spans[i].to, false, spans[i].rootAtTo};
      spans[i].to = horizon;
      spans[i].rootAtTo = false;
      spans.push_back(rest);
      break;
    }
    return spans;
  }
  /// Where total reflection begins on the column at x, as half tangent of y/(α·root) ≥ 0.
  float critical(float x, float root) const {
    if (!critical_) return 0;
    const float ratio = (w_.z + w_.x * x) / cosine_, q = ratio * ratio - 1.f - x * x;
    return q > 0 ? halfTangent(std::sqrt(q) / (alpha_ * root)) : 0.f;
  }

 private:
  float slope(float sine, float cosine) const { return cosine > 0 ? halfTangent(sine / (alpha_ * cosine)) : kEnd; }

  Vec3f w_;
  float alpha_, sine_, cosine_ = 1;  // of the critical angle
  bool critical_;
};

/// ∫ shares · cos²ψ dψ/2 over ψ in [0, π/2).
Vec3f integrateColumn(const Incidence& in, const Edges& edges, float x, float root, const GaussRule& rule) {
  Vec3f sum{};
  const auto add = [&](float t, float dt) {
    const float t2 = t * t, cosine = (1.f - t2) / (1.f + t2);
    sum += in.shares(x, in.alpha * root * 2.f * t / (1.f - t2)) * (cosine * cosine * dt / (1.f + t2));
  };
  const float edge = edges.critical(x, root);
  if (edge > 0) Span{0, edge, false, true}.integrate(rule, add);
  Span{edge, kEnd}.integrate(rule, add);
  return sum;
}

}  // namespace

/// E[shares] over the visible normals. In slopes their density is G1(w)/cosθ · (w.z + w.x x) · P22(x, y), with w in the
/// plane y = 0 and P22 = 1/(π α² (1 + (x² + y²)/α²)²) (Heitz 2014, "Understanding the masking-shadowing function in
/// microfacet-based BRDFs"). With x = α tan χ, y = α tan ψ / cos χ it becomes, without a tail,
///
///   G1(w)/cosθ · ½ (cosθ cos χ + α sinθ sin χ) dχ · (2/π) cos²ψ dψ
///
/// w·h = cos θc at y² = ((w.z + w.x x)/cos θc)² − 1 − x² = q(x). Half tangents spare the trigonometry.
Vec3f glassShares(float eta, bool thin, float alpha, float cosTheta, const GaussRule& rule) {
  const float c = std::min(std::max(cosTheta, 1e-4f), 1.f);
  const Vec3f w{std::sqrt((1.f - c) * (1.f + c)), 0, c};
  const Incidence in{eta, thin, alpha, w, ggxLambda(c, alpha)};
  const Edges edges(in);
  Vec3f sum{};
  for (const Span& row : edges.rows()) {
    if (!(row.to > row.from)) continue;
    row.integrate(rule, [&](float k, float dk) {
      const float k2 = k * k, root = (1.f + k2) / (1.f - k2);  // 1/cos χ
      const float seen = (w.z * (1.f - k2) + alpha * w.x * 2.f * k) / (1.f + k2) * (dk / (1.f + k2));
      sum += integrateColumn(in, edges, alpha * 2.f * k / (1.f - k2), root, rule) * seen;
    });
  }
  return sum * (8.f / kPi / (c * (1.f + in.lambda)));  // ½ dχ = dk/(1+k²), dψ = 2 dt/(1+t²), both signs of y
}

}  // namespace lucarne
