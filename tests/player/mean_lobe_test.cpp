// Highlights from mean directions, by the reference on the processor.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dlm/mean_direction.h"
#include "player/cell_tables.h"
#include "player/lobe.h"
#include "tests/player/coats.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"

namespace lucarne::mean_lobe_test {
namespace {

using test::coatOnly;
using test::directionAt;

struct Members {
  std::vector<int> psi;
  std::vector<MeanCell> cells;
  std::vector<Rgb> constant;  // light of radiance 1
  std::vector<Vec3f> means;   // of it

  Members(const DirectionSet& set, Vec3d n) {
    for (int k = 0; k < set.count(); ++k) {
      const MeanCell c = meanCell(set, k, n);
      if (!(c.cosIntegral > 0)) continue;
      psi.push_back(k);
      cells.push_back(c);
      constant.push_back(Rgb(c.cosIntegral));
      means.push_back(c.direction);
    }
  }
};

/// Largest relative difference of the radiance from that of constant light, over exponents and views.
float worstOfConstantLight(const DirectionSet& set, const Members& m, const std::vector<Vec3f>& means) {
  float worst = 0;
  for (const float exponent : {0.f, 1.f, 3.f, 10.f, 30.f, 100.f, 1e5f}) {
    for (int i = 0; i < 60; ++i) {
      const Vec3f toEye = directionAt(0.0265 * i, 2.4 * i);
      const Bsdf bsdf = coatOnly(exponent);
      const Rgb Lo = reflectedRadiance({{0, 0, 1}, toEye, set.count()}, bsdf, m.cells, m.constant, means,
                                       Rgb(std::numbers::pi_v<float>));
      const Rgb expected = Coat(bsdf).albedo(toEye.z).total;
      for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(Lo[c] / expected[c] - 1));
    }
  }
  return worst;
}

TEST(MeanLobe, ConstantLightGivesAConstantHighlight) {
  for (const int count : {1, 2, 14, 32, 64, 256}) {
    const DirectionSet set(count);
    const Members m(set, {0, 0, 1});
    EXPECT_LT(worstOfConstantLight(set, m, m.means), 1e-4f) << count;
  }
}

TEST(MeanLobe, ConstantLightStaysConstantWithinTheRoundingOfPackedMeans) {
  for (const int count : {1, 2, 14, 32, 64, 256}) {
    const DirectionSet set(count);
    const Members m(set, {0, 0, 1});
    const float reach = meanReach(count);
    std::vector<Vec3f> packed;
    for (std::size_t k = 0; k < m.means.size(); ++k) {
      const Vec3f psi(set.direction(m.psi[k]));
      packed.push_back(unpackMean(packMean(m.means[k], psi, reach), psi, reach));
    }
    EXPECT_LT(worstOfConstantLight(set, m, packed), count <= 64 ? 0.03f : 0.05f) << count;
  }
}

/// 2π: the weight is a density over directions times 2π.
TEST(MeanLobe, WeightsKeepTheEnergyOfTheLobe) {
  constexpr int kSteps = 20000;
  for (const float lobe : {1.f, 4.f, 11.f, 101.f}) {
    for (const float length : {0.f, 0.5f, 0.9f, 0.99f, 1.f}) {
      double sum = 0;
      for (int i = 0; i < kSteps; ++i) {
        const auto z = static_cast<float>(1 - (2 * i + 1.0) / kSteps);
        sum += static_cast<double>(meanWeight(lobe, {std::sqrt(1 - z * z), 0, z}, {0, 0, length}, 32)) * 2 / kSteps;
      }
      EXPECT_NEAR(sum, 1, 2e-3) << lobe << " " << length;
    }
  }
}

/// The middle of the highlight, over all mirror directions.
Vec3d highlightOf(const DirectionSet& set, const Members& m, Vec3f lamp, bool byMeans) {
  constexpr int kViews = 3000;
  std::vector<Rgb> values(m.cells.size());
  std::vector<Vec3f> means = m.means;
  std::vector<LobeCell> cells;
  const int psi = set.nearest(lamp);
  for (std::size_t k = 0; k < values.size(); ++k) {
    cells.push_back(lobeCell(set, m.psi[k], {0, 0, 1}));
    if (m.psi[k] == psi) values[k] = Rgb(1.f), means[k] = lamp;
  }
  Vec3d sum{};
  for (int i = 0; i < kViews; ++i) {
    const double z = (i + 0.5) / kViews, r = std::sqrt(1 - z * z), phi = 2.399963229728653 * i;
    const Vec3f toEye(Vec3d{r * std::cos(phi), r * std::sin(phi), z}), mirror{-toEye.x, -toEye.y, toEye.z};
    const LobeView view{{0, 0, 1}, toEye, set.count()};
    const float alpha = alphaFromPhong(10);
    const Rgb shown = byMeans ? mirroredRadiance(view, alpha, m.cells, values, means, {})
                              : mirroredRadiance(view, alpha, cells, values, {});
    sum += Vec3d(mirror) * static_cast<double>(shown.x);
  }
  return normalize(sum);
}

TEST(MeanLobe, AHighlightFollowsALampThatMovesThroughTheCells) {
  for (const int count : {14, 32, 64}) {
    const DirectionSet set(count);
    const Members m(set, {0, 0, 1});
    const double radius = 2 / std::sqrt(count);  // of a cap as large as a cell, radians
    double off = 0, offWithout = 0, step = 0, stepWithout = 0;
    Vec3d before{}, beforeWithout{};
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = -0.6 + 1.2 * i / kSteps;
      const Vec3d lamp{std::sin(angle), 0.1 * std::cos(angle), std::sqrt(0.99) * std::cos(angle)};
      const Vec3d with = highlightOf(set, m, Vec3f(lamp), true), without = highlightOf(set, m, Vec3f(lamp), false);
      off = std::max(off, length(with - lamp));
      offWithout = std::max(offWithout, length(without - lamp));
      if (i > 0) step = std::max(step, length(with - before)), stepWithout = std::max(stepWithout, length(without - beforeWithout));
      before = with;
      beforeWithout = without;
    }
    EXPECT_LT(off, 0.4 * radius) << count;        // the hemisphere's edge and the cells' unevenness pull at it
    EXPECT_LT(step, 0.25 * radius) << count;      // the lamp moves by 0.02
    EXPECT_GT(offWithout, 1.5 * off) << count;
    EXPECT_GT(stepWithout, 0.6 * radius) << count;  // from cell to cell
  }
}

TEST(MeanLobe, LightThatSpreadsIsShownWiderThanLightFromAPoint) {
  const DirectionSet set(32);
  const Vec3f r = directionAt(0.4, 1);
  const float lobe = coatSharpness(alphaFromPhong(100));
  const float point = meanWeight(lobe, r, r, 32), cell = meanWeight(lobe, r, r * (1 - 1 / 32.f), 32),
              wide = meanWeight(lobe, r, r * 0.8f, 32);
  EXPECT_GT(point, 1.5f * cell);
  EXPECT_GT(cell, 1.5f * wide);
}

}  // namespace
}  // namespace lucarne::mean_lobe_test
