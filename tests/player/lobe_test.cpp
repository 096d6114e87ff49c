#include "player/lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "player/cell_tables.h"
#include "tests/player/coats.h"
#include "tracer/optics/coat.h"
#include "tracer/optics/phong.h"

namespace lucarne::lobe_test {
namespace {

using test::coatOnly;
using test::directionAt;

std::vector<LobeCell> membersOf(const DirectionSet& set, Vec3d n) {
  std::vector<LobeCell> cells;
  for (int psi = 0; psi < set.count(); ++psi) {
    const LobeCell c = lobeCell(set, psi, n);
    if (c.cosIntegral > 0) cells.push_back(c);
  }
  return cells;
}

std::vector<Rgb> constantLight(const std::vector<LobeCell>& cells, Rgb L) {
  std::vector<Rgb> values;
  for (const LobeCell& c : cells) values.push_back(L * c.cosIntegral);
  return values;
}

TEST(Lobe, ConstantLightGivesItsRadianceTimesTheAlbedo) {
  const Rgb L{3.f, 2.f, 1.f};
  constexpr auto kNearest = DirectionFilter::nearest, kLinear = DirectionFilter::linear;
  for (const auto& [count, filter] : {std::pair(1, kNearest), {2, kNearest}, {14, kNearest}, {32, kNearest}, {64, kNearest},
                                      {256, kNearest}, {4, kLinear}, {14, kLinear}, {64, kLinear}}) {
    const DirectionSet set(count, filter);
    const auto cells = membersOf(set, {0, 0, 1});
    const auto values = constantLight(cells, L);
    for (const float exponent : {0.f, 1.f, 3.f, 10.f, 30.f, 100.f, 1e5f}) {
      for (int i = 0; i < 60; ++i) {
        const Vec3f toEye = directionAt(0.0265 * i, 2.4 * i);
        const Bsdf bsdf = coatOnly(exponent);
        const Rgb Lo = reflectedRadiance({{0, 0, 1}, toEye, count, LobeKind::cell, filter}, bsdf, cells, values,
                                         L * std::numbers::pi_v<float>);
        const Rgb expected = L * Coat(bsdf).albedo(toEye.z).total;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(Lo[c], expected[c], 1e-4f * expected[c]);
      }
    }
  }
}

TEST(Lobe, LambertIsAlbedoOverPiTimesIrradiance) {
  Bsdf lambert;
  lambert.diffuse = {0.5f, 0.25f, 1.f};
  const Rgb Lo = reflectedRadiance({{0, 0, 1}, directionAt(1, 2), 14}, lambert, {}, {}, Rgb(std::numbers::pi_v<float>));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(Lo[c], lambert.diffuse[c], 1e-6f);
}

TEST(Lobe, WeightsAgreeWithTheLobeAveragedOverTheCells) {
  // Half the summed difference of the normalised C·w, the share of the light that is taken from the wrong cell.
  for (const int count : {14, 32, 64}) {
    const DirectionSet set(count);
    std::vector<double> average(static_cast<std::size_t>(count)), cosine(average), samples(average);
    for (const double exponent : {1., 3., 10., 30., 100.}) {
      double worst = 0, sum = 0;
      constexpr int kViews = 12, kSamples = 20000;
      for (int view = 0; view < kViews; ++view) {
        const Vec3f r = directionAt(1.2 * view / kViews, 2.4 * view);
        std::fill(average.begin(), average.end(), 0.);
        std::fill(cosine.begin(), cosine.end(), 0.);
        std::fill(samples.begin(), samples.end(), 0.);
        for (int i = 0; i < kSamples; ++i) {  // equal areas of the upper hemisphere
          const Vec3f w = directionAt(std::acos((i + 0.5) / kSamples), 2.399963229728653 * i);
          const auto psi = static_cast<std::size_t>(set.nearest(w));
          samples[psi] += 1;
          cosine[psi] += w.z;
          average[psi] += std::pow(std::max(dot(r, w), 0.f), exponent);
        }
        std::vector<double> exact(average), ours(average);
        double exactSum = 0, ourSum = 0, difference = 0;
        const float lambda = lobeSharpness(alphaFromPhong(static_cast<float>(exponent)), count);
        for (int psi = 0; psi < count; ++psi) {
          const auto k = static_cast<std::size_t>(psi);
          const LobeCell cell = lobeCell(set, psi, {0, 0, 1});
          exact[k] = samples[k] > 0 ? cosine[k] * average[k] / samples[k] : 0;
          ours[k] = cell.cosIntegral * lobeWeight(lambda, dot(r, cell.direction));
          exactSum += exact[k];
          ourSum += ours[k];
        }
        for (std::size_t k = 0; k < exact.size(); ++k)
          difference += 0.5 * std::abs(exact[k] / exactSum - ours[k] / ourSum);
        sum += difference;
        worst = std::max(worst, difference);
      }
      EXPECT_LT(sum / kViews, 0.08) << count << " directions, exponent " << exponent;
      EXPECT_LT(worst, 0.2) << count << " directions, exponent " << exponent;
    }
  }
}

TEST(Lobe, NarrowLobesAreWidenedToTheCellAndStayFinite) {
  EXPECT_LT(lobeSharpness(1e-3f, 14), cellSharpness(14) * 1.0001f);
  EXPECT_GT(lobeSharpness(1e-3f, 14), cellSharpness(14) * 0.999f);
  // Members that are all far from the mirror direction: their mean, not 0/0.
  const std::vector<LobeCell> cells = {{{1, 0, 0}, 0.1f}, {{-1, 0, 0}, 0.1f}};
  const std::vector<Rgb> values = {Rgb(1.f), Rgb(3.f)};
  const Rgb Lo = mirroredRadiance({{0, 0, 1}, {0, 0, 1}, 4096}, 1e-3f, cells, values, Rgb(4.f));
  EXPECT_NEAR(Lo.x, 20.f, 1e-3f);
}

TEST(Lobe, DensitiesOfTheOtherLobesAreDensities) {
  for (const float exponent : {0.5f, 1.f, 10.f, 100.f}) {
    for (const int count : {2, 14, 256}) {
      const float cap = capCosine(count);
      double sample = 0;
      constexpr int kSteps = 100000;
      for (int i = 0; i < kSteps; ++i) {
        const double c = 1 - 2 * (i + 0.5) / kSteps;  // equal areas of the sphere
        sample += static_cast<double>(phongDensity(exponent, static_cast<float>(c)));
        const float averaged = phongDensityOverCap(exponent, static_cast<float>(c), cap);
        ASSERT_TRUE(averaged >= 0 && averaged <= 1.001f * phongDensity(exponent, 1)) << c;
      }
      EXPECT_NEAR(sample * 4 * std::numbers::pi / kSteps, 1, 1e-3);
      // Around the mirror direction itself the average over the cap is exact.
      const double inside = 1 - std::pow(static_cast<double>(std::max(cap, 0.f)), static_cast<double>(exponent) + 1);
      EXPECT_NEAR(phongDensityOverCap(exponent, 1, cap) * 4 * std::numbers::pi / count, inside, 1e-4);
    }
    // Small cells: that of the direction alone.
    for (const float c : {-0.5f, 0.3f, 0.9f, 0.99f}) {
      EXPECT_NEAR(phongDensityOverCap(exponent, c, capCosine(60000)), phongDensity(exponent, c),
                  0.02f * phongDensity(exponent, 1));
    }
  }
}

// What normalising is for: of constant light the others lose or make some, the more the narrower the lobe.
TEST(Lobe, OnlyTheNormalisedOneKeepsConstantLight) {
  const DirectionSet set(32);
  const auto cells = membersOf(set, {0, 0, 1});
  const auto values = constantLight(cells, Rgb(1.f));
  double worst[3] = {};
  for (const LobeKind lobe : {LobeKind::cell, LobeKind::barsi, LobeKind::sample}) {
    for (int i = 0; i < 40; ++i) {
      const LobeView view{{0, 0, 1}, directionAt(0.02 * i, 2.4 * i), 32, lobe};
      const float shown = mirroredRadiance(view, alphaFromPhong(50), cells, values, Rgb(1.f)).x;
      double& w = worst[static_cast<int>(lobe)];
      w = std::max(w, std::abs(static_cast<double>(shown) - 1));
    }
  }
  EXPECT_LT(worst[0], 1e-5);
  EXPECT_GT(worst[1], 0.02);
  EXPECT_GT(worst[2], 2 * worst[1]);
}

TEST(Lobe, MirrorDirectionIsUnitAndNeverBelowTheHorizon) {
  for (int i = 0; i < 200; ++i) {
    const Vec3f toEye = directionAt(0.0157 * i, 1.7 * i);  // also from behind
    const Vec3f r = mirrorDirection({0, 0, 1}, toEye);
    EXPECT_NEAR(length(r), 1.f, 1e-5f);
    EXPECT_GE(r.z, -1e-6f);
    if (toEye.z > 0) {
      EXPECT_NEAR(r.z, toEye.z, 1e-6f);
    }
  }
}

TEST(Lobe, AHighlightFollowsItsLightInBrightness) {
  const DirectionSet set(64);
  const auto cells = membersOf(set, {0, 0, 1});
  for (std::size_t lamp = 0; lamp < cells.size(); ++lamp) {
    std::vector<Rgb> values(cells.size());
    values[lamp] = Rgb(cells[lamp].cosIntegral);
    const Vec3f d = cells[lamp].direction, mirror{-d.x, -d.y, d.z}, away{d.x, d.y, d.z};
    const float alpha = alphaFromPhong(30);
    const float at = mirroredRadiance({{0, 0, 1}, mirror, 64}, alpha, cells, values, {}).x;
    if (d.z < 0.8f) {
      EXPECT_GT(at, 2 * mirroredRadiance({{0, 0, 1}, away, 64}, alpha, cells, values, {}).x);
    }
    EXPECT_LE(at, 1.0001f);  // no brighter than the lamp
  }
}

}  // namespace
}  // namespace lucarne::lobe_test
