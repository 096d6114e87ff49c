// A bake with guided emission is the same bake with less noise.
#include <gtest/gtest.h>

#include "tests/app/bake_fixture.h"
#include "tests/app/truth_scenes.h"
#include "tests/tracer/mean.h"

namespace lucarne::guided_bake_test {
namespace {

/// Light on each chart side, lm, over several bakes that differ in their seed alone.
std::vector<test::Mean> chartTotals(bool guided, int bakes) {
  const Scene room = test::windowRoom();
  const auto sky = test::sunnySky();
  std::vector<test::Mean> totals;
  for (int k = 0; k < bakes; ++k) {
    BakeOptions options = test::quickOptions(40'000, 1);
    options.seed = static_cast<std::uint64_t>(100 + k);
    options.sampler = SamplerKind::random;
    options.guidedEmission = guided;
    const test::BakedScene b(room, options, sky.get());
    EXPECT_EQ(b.photonScene.emitters().guides().size(), guided ? 1u : 0u);
    std::vector<double> sums(b.baked.maps.sides.size());
    test::forEachTexel(b, [&](const SideMaps& side, std::uint64_t texel, double area) {
      const auto s = static_cast<std::size_t>(&side - b.baked.maps.sides.data());
      sums[s] += static_cast<double>(luminance(b.baked.maps.irradiance[texel])) * area;
    });
    totals.resize(sums.size());
    for (std::size_t s = 0; s < sums.size(); ++s) totals[s].add(sums[s]);
  }
  return totals;
}

TEST(GuidedBake, HasTheSameChartTotalsWithLessVariance) {
  constexpr int kBakes = 24;
  const std::vector<test::Mean> plain = chartTotals(false, kBakes), guided = chartTotals(true, kBakes);
  ASSERT_EQ(plain.size(), guided.size());
  double plainVariance = 0, guidedVariance = 0;
  std::size_t lit = 0;
  for (std::size_t s = 0; s < plain.size(); ++s) {
    if (!(plain[s].sum > 0)) continue;
    ++lit;
    // Errors from 24 bakes are themselves uncertain: Student's t with 23 degrees of freedom has wider tails.
    const double error = std::hypot(plain[s].error(), guided[s].error());
    EXPECT_NEAR(guided[s].mean(), plain[s].mean(), 5 * error) << s;
    plainVariance += plain[s].variance() / (plain[s].mean() * plain[s].mean());
    guidedVariance += guided[s].variance() / (guided[s].mean() * guided[s].mean());
  }
  EXPECT_GT(lit, 5u);
  EXPECT_LT(guidedVariance, 0.6 * plainVariance);
}

}  // namespace
}  // namespace lucarne::guided_bake_test
