// Light goes into the directions it comes from: exactly where a cell can be named, statistically where it is spread.
#include <gtest/gtest.h>

#include <set>

#include "tests/app/deviation.h"

namespace lucarne::direction_light_test {
namespace {

using test::BakedScene;
using test::fraction;
using test::kPi64;
using test::SceneBuilder;

Material glossyFloor() {
  Material m = test::diffuseMaterial(Rgb(0.3f));
  m.specular = 1;
  m.roughness = 0.4f;
  return m;
}

/// Adds a floor of 2 × 2 m at y = 0, facing up.
void addFloor(SceneBuilder& s, std::uint32_t material) {
  s.addQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, material);
}

BakeOptions directOnly(int directions, std::uint64_t photons, double density) {
  BakeOptions o = test::quickOptions(photons, density);
  o.directions = directions;
  o.light = LightPart::direct;
  o.kernel.width = 0.5;  // each texel by itself
  return o;
}

class DirectLight : public testing::TestWithParam<int> {};

TEST_P(DirectLight, OfTheSunIsInTheOneCellThatHoldsIt) {
  const DirectionSet set(GetParam());
  for (int i = 0; i < 12; ++i) {
    const double height = 0.08 + 0.077 * i, angle = 2.4 * i, r = std::sqrt(1 - height * height);
    SceneBuilder s;
    addFloor(s, s.addMaterial(glossyFloor()));
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = -Vec3d{r * std::cos(angle), height, r * std::sin(angle)};
    sun.intensity = Rgb(1000.f);
    s.addLight(sun);
    const BakedScene b(s.build(), directOnly(GetParam(), 20'000, 4));
    const SideMaps& side = b.baked.maps.sides.at(0);
    ASSERT_TRUE(side.lit);
    int stored = 0;
    for (const SideDirection& d : side.directions) {
      if (!d.stored()) continue;
      ++stored;
      EXPECT_EQ(d.psi, set.nearest(-Vec3f(sun.direction)));
      for (std::uint64_t t = 0; t < side.texelCount(); ++t)  // all of E, to the bit
        EXPECT_EQ(b.baked.maps.directional[d.first + t], b.baked.maps.irradiance[side.firstTexel + t]);
    }
    EXPECT_EQ(stored, 1) << "sun " << i;
  }
}

/// True if the cell of ψ may hold a direction v within `angle` (radians) of `w`, which is in the cell of φ: v·(φ − ψ)
/// differs from w·(φ − ψ) by |v − w|·|φ − ψ| at most.
bool mayHold(const DirectionSet& set, int psi, Vec3d w, double angle) {
  const Vec3d apart = set.direction(set.nearest(Vec3f(w))) - set.direction(psi);
  return dot(apart, w) <= angle * length(apart) + 1e-6;
}

/// Middle of texel t of the floor in metres: its chart's axes and sizes tell.
Vec3d middleOf(const BakedScene& b, std::uint64_t t) {
  const Chart& chart = b.plan.charts.charts.at(0);
  const ChartLayout& layout = b.plan.layout.charts.at(0);
  const double x = static_cast<double>(t % static_cast<std::uint64_t>(layout.width)) + 0.5;
  const double y = static_cast<double>(t / static_cast<std::uint64_t>(layout.width)) + 0.5;
  // From corner 0 of triangle 0, whose place in the chart is known.
  const Vec2f corner = b.plan.charts.cornerUv.at(0)[0];
  const Vec3d local = Vec3d(b.scene.corner(0, 0)) +
                      chart.axisU * (x / layout.texelsPerLocal.x - static_cast<double>(corner.x)) +
                      chart.axisV * (y / layout.texelsPerLocal.y - static_cast<double>(corner.y));
  return b.scene.frame.toWorld(local);
}

TEST_P(DirectLight, OfASmallLampIsInTheCellsThatItSubtendsAndNowhereElse) {
  SceneBuilder s;
  addFloor(s, s.addMaterial(glossyFloor()));
  Light lamp;
  lamp.position = {0.23, 0.9, -0.31};
  lamp.intensity = Rgb(100.f);
  s.addLight(lamp);
  const BakedScene b(s.build(), directOnly(GetParam(), 2'000'000, 10));
  const DirectionSet set(GetParam());
  const SideMaps& side = b.baked.maps.sides.at(0);
  ASSERT_EQ(side.texelCount(), 400u);
  const double halfDiagonal = 0.05 * std::sqrt(2.);
  double worst = 0;
  std::uint64_t whole = 0, cells = 0;
  for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
    const Vec3d to = lamp.position - middleOf(b, t), w = normalize(to);
    const double angle = std::asin(halfDiagonal / length(to));
    int possible = 0;
    for (int psi = 0; psi < set.count(); ++psi) possible += mayHold(set, psi, w, angle) ? 1 : 0;
    const double e = static_cast<double>(b.baked.maps.irradiance[side.firstTexel + t].y);
    double sum = 0;
    for (const SideDirection& d : side.directions) {
      const double value = d.stored() ? static_cast<double>(b.baked.maps.directional[d.first + t].y) : 0;
      sum += value;
      if (value <= 0) continue;
      ++cells;
      EXPECT_TRUE(mayHold(set, d.psi, w, angle)) << "texel " << t << " direction " << d.psi;
      if (possible == 1) {
        ++whole;
        EXPECT_EQ(value, e);
      }
    }
    EXPECT_NEAR(sum, e, 1e-6 * e);
    // I·cosθ/d² in the middle of the texel; its mean over the texel differs by up to h²/6·3/d² by both axes.
    const double expected = 100 * to.y / std::pow(length(to), 3), bias = 2 * 0.05 * 0.05 / 6 * 3 / dot(to, to);
    const double se = static_cast<double>(b.baked.maps.relativeError[side.firstTexel + t]);
    worst = std::max(worst, (std::abs(e / expected - 1) - bias) / se);
  }
  EXPECT_LT(worst, test::zThreshold(400));
  EXPECT_GT(whole, GetParam() == 14 ? 100u : 20u);  // texels that see the lamp in one cell
  EXPECT_GT(cells, 400u);
}
INSTANTIATE_TEST_SUITE_P(Directions, DirectLight, testing::Values(14, 64));

/// In a black furnace every photon ends at its first wall and carries the same, so counts are binomial and everything
/// about them is exact: B_ψ of one texel is L·∫_cell cos, its share of N photons B_ψ·area/flux.
class UniformLight : public testing::TestWithParam<int> {};

BakedScene furnaceOfDirections(int directions, std::uint64_t photons, double density) {
  SceneBuilder s;
  s.addBox({-1, 0, -1}, {1, 1.5, 1}, s.addDiffuse(Rgb(0.f), Rgb(100.f)), true);
  BakeOptions o = test::quickOptions(photons, density);
  o.directions = directions;
  o.keepAllDirections = true;
  o.kernel.width = 0.5;
  return BakedScene(s.build(), o);
}

struct BinomialCheck {
  double worst = 0;
  std::uint64_t questions = 0;
};

/// |z| of every B_ψ of every texel whose expected count is 25 or more.
BinomialCheck checkCells(const BakedScene& b, int directions, std::uint64_t photons) {
  const DirectionSet set(directions);
  BinomialCheck check;
  for (const SideMaps& side : b.baked.maps.sides) {
    const Vec3d n(b.baked.maps.charts[side.chart].normal);
    const std::uint64_t first = b.plan.layout.charts[side.chart].firstTexel;
    const double square = b.scene.frame.scale * b.scene.frame.scale;
    double total = 0;
    for (const SideDirection& d : side.directions) {
      const double expected = 100 * set.clippedCell(d.psi, n).cosIntegral;
      total += expected;
      for (std::uint64_t t = 0; t < side.texelCount(); ++t) {
        const double p = expected * b.plan.layout.area[first + t] * square / b.baked.emittedFlux;
        const double count = p * static_cast<double>(photons);
        const double value = d.stored() ? static_cast<double>(b.baked.maps.directional[d.first + t].y) : 0;
        if (expected <= 0) {
          EXPECT_EQ(value, 0);
        }
        if (count < 25) continue;
        check.worst = std::max(check.worst, std::abs(value / expected - 1) * std::sqrt(count / (1 - p)));
        ++check.questions;
      }
    }
    EXPECT_NEAR(total, 100 * kPi64, 1e-6);  // the members' cells cover the hemisphere
  }
  return check;
}

TEST_P(UniformLight, FillsEveryClippedCellByItsCosineIntegral) {
  constexpr std::uint64_t kPhotons = 4'000'000;
  const BinomialCheck whole = checkCells(furnaceOfDirections(GetParam(), kPhotons, 1e-3), GetParam(), kPhotons);
  EXPECT_GT(whole.questions, static_cast<std::uint64_t>(6 * GetParam() / 2));
  EXPECT_LT(whole.worst, test::zThreshold(whole.questions)) << whole.questions << " cells";
}

TEST_P(UniformLight, FillsThemTexelByTexel) {
  constexpr std::uint64_t kPhotons = 1'000'000;
  const BinomialCheck each = checkCells(furnaceOfDirections(GetParam(), kPhotons, 3), GetParam(), kPhotons);
  EXPECT_GT(each.questions, static_cast<std::uint64_t>(20 * GetParam()));
  EXPECT_LT(each.worst, test::zThreshold(each.questions)) << each.questions << " cells";
}
INSTANTIATE_TEST_SUITE_P(Directions, UniformLight, testing::Values(14, 64));

}  // namespace
}  // namespace lucarne::direction_light_test
