// How far a lobe as it is shown lies from the lobe itself, where hits are counted by cell or shared among three ψ.
//
//   filter_study
//
// Light from ω on a surface of normal n shows as Σ s_ψ(ω) w_ψ / Σ C_ψ w_ψ, s the shares of ψ and C what constant light
// leaves there (player/lobe.h). The truth is the lobe at ω over what it makes of constant light. Told is the RMS
// difference over the truth's RMS, over ω by their cosine and over many normals and mirror directions.
#include <cstdio>
#include <numbers>
#include <random>

#include "dlm/direction_shares.h"
#include "dlm/lobe_width.h"
#include "player/cell_tables.h"

namespace lucarne {
namespace {

constexpr int kViews = 60, kLights = 4000;
constexpr double kLeastCosine = 0.1;  // of mirror directions: 84 degrees off the normal

/// Evenly spread directions.
std::vector<Vec3d> spiral() {
  std::vector<Vec3d> points;
  for (int i = 0; i < kLights; ++i) {
    const double z = 1 - (2 * i + 1.0) / kLights, phi = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    points.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  return points;
}

double gaussian(double sharpness, double cosine) { return std::exp(std::max(-60., sharpness * (cosine - 1))); }

struct View {
  Vec3d n, mirror;
};

std::vector<View> someViews() {
  std::mt19937_64 rng(1);
  std::normal_distribution<double> normal;
  const auto unit = [&] { return normalize(Vec3d{normal(rng), normal(rng), normal(rng)}); };
  std::vector<View> views;
  while (views.size() < kViews) {
    const View v{unit(), unit()};
    if (dot(v.n, v.mirror) > kLeastCosine) views.push_back(v);
  }
  return views;
}

MemberSet membersOf(const DirectionSet& set, Vec3d n) {
  MemberSet m;
  for (int psi = 0; psi < set.count(); ++psi) {
    m.rank.push_back(static_cast<std::uint16_t>(set.reaches(psi, n) ? m.members.size() : 0));
    if (set.reaches(psi, n)) m.members.push_back(static_cast<std::uint16_t>(psi));
  }
  return m;
}

/// w over Σ C w, by rank.
std::vector<double> shownWeights(const DirectionSet& set, const MemberSet& m, const View& view, double sharpness) {
  std::vector<double> weights;
  double constant = 0;
  for (const std::uint16_t psi : m.members) {
    const LobeCell cell = lobeCell(set, psi, view.n);
    weights.push_back(gaussian(sharpness, dot(Vec3d(cell.direction), view.mirror)));
    constant += static_cast<double>(cell.cosIntegral) * weights.back();
  }
  for (double& w : weights) w /= constant;
  return weights;
}

double errorOf(int count, DirectionFilter filter, double exponent, const std::vector<Vec3d>& points) {
  const DirectionSet set(count, filter);
  const double lobe = exponent + 1, cell = static_cast<double>(cellSharpness(count, filter));
  double error = 0, power = 0;
  for (const View& view : someViews()) {
    const MemberSet m = membersOf(set, view.n);
    const std::vector<double> weights = shownWeights(set, m, view, lobe * cell / (lobe + cell));
    double constant = 0;
    for (const Vec3d& w : points)
      constant += std::max(0.0, dot(w, view.n)) * gaussian(lobe, dot(w, view.mirror)) * 4 * std::numbers::pi / kLights;
    for (const Vec3d& w : points) {
      const double cosine = dot(w, view.n);
      if (cosine <= 0) continue;
      const DirectionShares shares = directionShares(set, m, Vec3f(w));
      double shown = 0;
      std::uint32_t before = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        shown += weights[shares.rank[k]] * (shares.upTo[k] - before) / DirectionWeights::kWhole;
        before = shares.upTo[k];
      }
      const double truth = gaussian(lobe, dot(w, view.mirror)) / constant;
      error += cosine * (shown - truth) * (shown - truth);
      power += cosine * truth * truth;
    }
  }
  return 100 * std::sqrt(error / power);
}

void run() {
  const std::vector<Vec3d> points = spiral();
  std::printf("%8s %10s %8s %8s\n", "exponent", "directions", "nearest", "linear");
  for (const double exponent : {1., 3., 10., 30., 100., 300.})
    for (const int count : {14, 32, 64, 256})
      std::printf("%8.0f %10d %7.1f%% %7.1f%%\n", exponent, count,
                  errorOf(count, DirectionFilter::nearest, exponent, points),
                  errorOf(count, DirectionFilter::linear, exponent, points));
}

}  // namespace
}  // namespace lucarne

int main() { lucarne::run(); }
