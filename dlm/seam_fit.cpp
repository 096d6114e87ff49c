#include "dlm/seam_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

constexpr double kKeep = 0.03;  // λ: large enough that texels which a seam hardly reads stay as they are
constexpr int kMostSteps = 100;
constexpr double kAccuracy = 1e-6;  // of the residual, relative

/// One row of the jump matrix: lookup on side a minus lookup on side b, in unknowns.
struct JumpRow {
  std::array<std::uint32_t, 8> unknown;
  std::array<double, 8> weight;
};

/// Rows and the texels that they read. All values of one map of each side lie in one array of texels.
class JumpSystem {
 public:
  void add(const SeamSample& s, std::uint64_t firstA, std::uint64_t firstB) {
    for (std::size_t i = 0; i < 4; ++i) {
      places_.push_back(firstA + s.a.texel[i]);
      places_.push_back(firstB + s.b.texel[i]);
      weights_.push_back(s.a.weight[i]);
      weights_.push_back(-s.b.weight[i]);
    }
  }

  /// Numbers the unknowns.
  void finish() {
    texels_ = places_;
    std::sort(texels_.begin(), texels_.end());
    texels_.erase(std::unique(texels_.begin(), texels_.end()), texels_.end());
    rows_.resize(places_.size() / 8);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto at = std::lower_bound(texels_.begin(), texels_.end(), places_[i]);
      rows_[i / 8].unknown[i % 8] = static_cast<std::uint32_t>(at - texels_.begin());
      rows_[i / 8].weight[i % 8] = weights_[i];
    }
    places_ = {};
    weights_ = {};
  }

  bool empty() const { return places_.empty() && rows_.empty(); }

  /// Changes `values` so that the jumps are small. A value never gets below zero.
  void fit(std::vector<Rgb>& values) const {
    std::vector<Rgbd> at(texels_.size());
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = Rgbd(values[texels_[i]]);
    const std::vector<Rgbd> change = solve(at);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Rgbd fitted = at[i] + change[i];
      values[texels_[i]] = Rgb(Rgbd{std::max(0.0, fitted.x), std::max(0.0, fitted.y), std::max(0.0, fitted.z)});
    }
  }

 private:
  using Vector = std::vector<Rgbd>;  // three systems of one matrix: a column a channel

  /// Jᵀ W J x, W = ½: two places stand for a texel's length.
  Vector apply(const Vector& x) const {
    Vector y(x.size());
    for (const JumpRow& row : rows_) {
      Rgbd jump{};
      for (std::size_t i = 0; i < 8; ++i) jump += x[row.unknown[i]] * row.weight[i];
      for (std::size_t i = 0; i < 8; ++i) y[row.unknown[i]] += jump * (0.5 * row.weight[i]);
    }
    return y;
  }

  static Rgbd dots(const Vector& a, const Vector& b) {
    Rgbd sum{};
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }

  static Rgbd ratio(Rgbd a, Rgbd b) {
    const auto of = [](double x, double y) { return y > 0 ? x / y : 0; };
    return {of(a.x, b.x), of(a.y, b.y), of(a.z, b.z)};
  }

  /// Conjugate gradients on (Jᵀ W J + λ) Δ = −Jᵀ W J v.
  Vector solve(const Vector& v) const {
    Vector change(v.size()), residual = apply(v);
    for (Rgbd& r : residual) r = -r;
    Vector direction = residual;
    Rgbd square = dots(residual, residual);
    const Rgbd enough = square * (kAccuracy * kAccuracy);
    for (int step = 0; step < kMostSteps; ++step) {
      if (square.x <= enough.x && square.y <= enough.y && square.z <= enough.z) break;
      Vector image = apply(direction);
      for (std::size_t i = 0; i < image.size(); ++i) image[i] += direction[i] * kKeep;
      const Rgbd length = ratio(square, dots(direction, image));
      for (std::size_t i = 0; i < change.size(); ++i) {
        change[i] += direction[i] * length;
        residual[i] = residual[i] - image[i] * length;
      }
      const Rgbd next = dots(residual, residual), turn = ratio(next, square);
      for (std::size_t i = 0; i < direction.size(); ++i) direction[i] = residual[i] + direction[i] * turn;
      square = next;
    }
    return change;
  }

  std::vector<std::uint64_t> places_, texels_;
  std::vector<double> weights_;
  std::vector<JumpRow> rows_;
};

Rgbd lookedUp(const std::vector<Rgb>& values, std::uint64_t first, const SideLookup& look) {
  Rgbd sum{};
  for (std::size_t i = 0; i < 4; ++i) sum += Rgbd(values[first + look.texel[i]]) * look.weight[i];
  return sum;
}

struct Jumps {
  double all = 0, worst = 0;
};

Jumps measure(const SeamSet& set, const LightMaps& maps) {
  Jumps jumps;
  double difference = 0, mean = 0;
  for (const Seam& seam : set.seams) {
    double d = 0, m = 0;
    for (std::size_t i = seam.first; i < seam.end; ++i) {
      const SeamSample& s = set.samples[i];
      const double a = luminance(lookedUp(maps.irradiance, maps.sides[s.sideA].firstTexel, s.a)),
                   b = luminance(lookedUp(maps.irradiance, maps.sides[s.sideB].firstTexel, s.b));
      d += s.length * (a - b) * (a - b);
      m += s.length * 0.25 * (a + b) * (a + b);
    }
    difference += d;
    mean += m;
    if (m > 0) jumps.worst = std::max(jumps.worst, std::sqrt(d / m));
  }
  jumps.all = mean > 0 ? std::sqrt(difference / mean) : 0;
  return jumps;
}

double fluxOf(const LightMaps& maps, const TexelLayout& layout) {
  double flux = 0;
  for (const SideMaps& side : maps.sides) {
    if (!side.lit) continue;
    for (std::uint64_t t = 0; t < side.texelCount(); ++t)
      flux += layout.area[layout.charts[side.chart].firstTexel + t] *
              static_cast<double>(luminance(maps.irradiance[side.firstTexel + t]));
  }
  return flux;
}

void fitIrradiance(const SeamSet& set, LightMaps& maps) {
  JumpSystem system;
  for (const SeamSample& s : set.samples) system.add(s, maps.sides[s.sideA].firstTexel, maps.sides[s.sideB].firstTexel);
  system.finish();
  system.fit(maps.irradiance);
}

const SideDirection* storedMap(const SideMaps& side, std::uint16_t psi) {
  const auto at = std::lower_bound(side.directions.begin(), side.directions.end(), psi,
                                   [](const SideDirection& d, std::uint16_t p) { return d.psi < p; });
  return at != side.directions.end() && at->psi == psi && at->stored() ? &*at : nullptr;
}

/// The maps of different ψ share no texel, so that they are fitted side by side.
void fitDirections(const SeamSet& set, LightMaps& maps) {
  tbb::parallel_for(0, maps.directionCount, [&](int psi) {
    JumpSystem system;
    for (const SeamSample& s : set.samples) {
      const SideDirection* a = storedMap(maps.sides[s.sideA], static_cast<std::uint16_t>(psi));
      const SideDirection* b = storedMap(maps.sides[s.sideB], static_cast<std::uint16_t>(psi));
      if (a != nullptr && b != nullptr) system.add(s, a->first, b->first);
    }
    if (system.empty()) return;
    system.finish();
    system.fit(maps.directional);
  });
}

/// Scales the light by direction of texels at seams to the irradiance.
void restoreSums(const SeamSet& set, LightMaps& maps) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> texels;  // side, texel
  for (const SeamSample& s : set.samples) {
    for (const std::uint32_t t : s.a.texel) texels.emplace_back(s.sideA, t);
    for (const std::uint32_t t : s.b.texel) texels.emplace_back(s.sideB, t);
  }
  std::sort(texels.begin(), texels.end());
  texels.erase(std::unique(texels.begin(), texels.end()), texels.end());
  for (const auto& [index, t] : texels) {
    const SideMaps& side = maps.sides[index];
    Rgbd sum{};
    for (const SideDirection& d : side.directions)
      if (d.stored()) sum += Rgbd(maps.directional[d.first + t]);
    const Rgbd wanted(maps.irradiance[side.firstTexel + t]);
    const auto of = [](double w, double s) { return s > 0 ? w / s : 0; };
    const Rgbd factor{of(wanted.x, sum.x), of(wanted.y, sum.y), of(wanted.z, sum.z)};
    for (const SideDirection& d : side.directions)
      if (d.stored()) maps.directional[d.first + t] = Rgb(Rgbd(maps.directional[d.first + t]) * factor);
  }
}

}  // namespace

SeamReport fitSeams(const SeamSet& set, const TexelLayout& layout, LightMaps& maps, bool fit) {
  SeamReport report;
  report.seams = set.seams.size();
  for (const SeamSample& s : set.samples) report.length += s.length;
  const Jumps before = measure(set, maps);
  report.jumpBefore = report.jumpAfter = before.all;
  report.worstBefore = report.worstAfter = before.worst;
  if (!fit || set.samples.empty()) return report;
  const double flux = fluxOf(maps, layout);
  fitIrradiance(set, maps);
  fitDirections(set, maps);
  restoreSums(set, maps);
  const Jumps after = measure(set, maps);
  report.jumpAfter = after.all;
  report.worstAfter = after.worst;
  report.fluxChange = flux > 0 ? fluxOf(maps, layout) / flux - 1 : 0;
  return report;
}

}  // namespace lucarne
