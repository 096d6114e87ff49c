// What resolve makes of tallies: kernels, smooth shading, and whether the error it states is the error it has.
#include <gtest/gtest.h>

#include "dlm/resolve.h"
#include "tests/app/deviation.h"
#include "tests/support/smooth_sphere.h"

namespace lucarne::extremes_maps_test {
namespace {

using test::BakedScene;
using test::deviationFrom;
using test::kPi64;
using test::ProbedBake;
using test::SceneBuilder;

TEST(Kernels, OfAnyShapeAndWidthKeepConstantLightConstant) {
  SceneBuilder s;
  const auto wall = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  s.addBox({0, 0, 0}, {2, 1.3, 1.7}, wall, true);
  // Charts that are no rectangles: texels that hold little or nothing.
  s.addTriangle({0.3, 0.4, 0.3}, {1.7, 0.5, 0.4}, {0.9, 0.8, 1.3}, wall);
  s.addTriangle({0.3, 0.4, 0.3}, {0.9, 0.8, 1.3}, {1.7, 0.5, 0.4}, wall);
  for (const KernelShape shape : {KernelShape::pyramid, KernelShape::box, KernelShape::epanechnikov}) {
    for (const double width : {0.5, 1.0, 1.5, 3.0, 16.0}) {
      BakeOptions o = test::quickOptions(600'000, 6);
      o.kernel = {shape, width};
      const BakedScene b(s.build(), o);
      // Above 0.5 the kernel gathers a few texels at least. Below, slivers of a texel may hold a photon or none.
      double worst = 0;
      std::uint64_t texels = 0;
      forEachTexel(b, [&](const SideMaps&, std::uint64_t t, double) {
        const double e = static_cast<double>(b.baked.maps.irradiance[t].y);
        const double se = static_cast<double>(b.baked.maps.relativeError[t]) * std::sqrt(e * kPi64 * 200);
        if (static_cast<double>(b.baked.maps.relativeError[t]) > 0.2 || e <= 0) return;
        worst = std::max(worst, std::abs(e - kPi64 * 200) / se);
        ++texels;
      });
      EXPECT_GT(texels, 600u);
      EXPECT_LT(worst, test::zThreshold(texels)) << static_cast<int>(shape) << " " << width;
      EXPECT_LT(deviationFrom(b, kPi64 * 200).ofMean, 4) << static_cast<int>(shape) << " " << width;
    }
  }
}

/// A room with what makes estimates hard: many bounces, a coat, an emitter beside a point light, strong gradients.
Scene mixedRoom() {
  SceneBuilder s;
  Material coated = test::diffuseMaterial(Rgb(0.4f));
  coated.specular = 1;
  coated.roughness = 0.45f;
  s.addBox({0, 0, 0}, {3, 2, 2.5}, s.addDiffuse({0.9f, 0.9f, 0.45f}), true);
  s.addBox({1, 0, 1}, {1.7, 0.8, 1.6}, s.addMaterial(coated), false);
  s.addBox({1.2, 1.8, 1}, {1.6, 1.85, 1.4}, s.addDiffuse(Rgb(0.1f), {900, 700, 300}), false);
  Light l;
  l.position = {0.4, 1.5, 2};
  l.intensity = Rgb(30.f);
  s.addLight(l);
  return s.build();
}

/// Squares of what is stated and of what the seeds show, relative to the mean of each texel, summed over texels with 20
/// photons or more.
struct Honesty {
  double stated = 0;
  std::vector<double> seen;  // by seed, unbiased
};

Honesty honestyOf(const KernelOptions& kernel, int seeds) {
  const Scene scene = mixedRoom();
  std::vector<std::vector<double>> value, error;
  std::vector<double> photons;
  for (int seed = 0; seed < seeds; ++seed) {
    BakeOptions o = test::quickOptions(100'000, 5);
    o.seed = static_cast<std::uint64_t>(seed);
    o.kernel = kernel;
    const BakedScene b(scene, o);
    value.emplace_back();
    error.emplace_back();
    const LightMaps& maps = b.baked.maps;
    photons.resize(maps.irradiance.size());
    for (std::size_t t = 0; t < maps.irradiance.size(); ++t) {
      value.back().push_back(static_cast<double>(luminance(maps.irradiance[t])));
      error.back().push_back(static_cast<double>(maps.relativeError[t]) * value.back().back());
      photons[t] += static_cast<double>(maps.photons[t]) / seeds;
    }
  }
  Honesty h;
  h.seen.resize(value.size());
  for (std::size_t t = 0; t < photons.size(); ++t) {
    if (photons[t] < 20) continue;
    double mean = 0, stated = 0;
    for (std::size_t k = 0; k < value.size(); ++k) {
      mean += value[k].at(t) / seeds;
      stated += error[k].at(t) * error[k].at(t) / seeds;
    }
    h.stated += stated / (mean * mean);
    for (std::size_t k = 0; k < value.size(); ++k)
      h.seen[k] += std::pow(value[k][t] / mean - 1, 2) * seeds / (seeds - 1);
  }
  return h;
}

TEST(ErrorEstimate, IsWhatTheSeedsShow) {
  for (const double width : {0.5, 1.5}) {
    constexpr int kSeeds = 12;
    const Honesty h = honestyOf({KernelShape::pyramid, width}, kSeeds);
    double mean = 0, square = 0;
    for (const double s : h.seen) mean += s / h.stated / kSeeds;
    for (const double s : h.seen) square += std::pow(s / h.stated - mean, 2) / (kSeeds - 1);
    const double se = std::sqrt(square / kSeeds);
    EXPECT_LT(se, 0.04) << "the question must be sharp enough";
    // Texels beside each other that one photon visits add a little that the estimate leaves out: 3 % at width 1.5.
    EXPECT_NEAR(mean, 1, 0.03 + 4 * se) << "width " << width << " ± " << se;
    EXPECT_NEAR(mean, 1, 0.15);
  }
}

/// What a facet stores of constant light, as its normals receive it, relative to what the sphere would: see below.
double facetBias(double sine) { return sine * sine / 12 + 0.0064 * sine + 5e-5; }

/// In light of constant radiance L the store of a facet is ∫ L·min(ns·w, 4 n·w) where the shading normal ns serves, and
/// ∫ L·n·w where it does not (ns·w ≤ 0.01). With 0 for 0.01 and without the clamp the two lunes make it exactly πL:
/// n's hemisphere cut by ns holds π/2·(1 + cos δ), the rest by n itself π/2·(1 − cos δ). The clamp takes
/// ∫∫ (sinδ·cosφ − 3h)₊ dh dφ ≤ π·sin²δ/12; the strip 0 < ns·w < 0.01 has at most 0.01·∫ sinδ·(cosφ)₊ dφ = 0.02·sinδ
/// too much and ½·10⁻⁴·π too little. Divided by π: facetBias.
TEST(SmoothSphere, OfBlackInAFurnaceReadsPiTimesTheRadianceEverywhere) {
  for (const int cells : {3, 12}) {  // facets 20° and 5° off
    SceneBuilder s;
    s.addBox({-1, -1, -1}, {1, 1, 1}, s.addDiffuse(Rgb(0.f), Rgb(100.f)), true);
    const auto ball = s.addDiffuse(Rgb(0.f), Rgb(100.f));
    test::addSphere(s, {0.1, -0.05, 0.15}, 0.7, ball, cells);
    Scene scene = s.build();
    test::smoothen(scene, ball, {0.1, -0.05, 0.15});
    const BakedScene b(scene, test::quickOptions(1'500'000, 10));
    const double bias = facetBias(test::largestFacetSine(scene, ball));
    const test::Deviation d = deviationFrom(b, kPi64 * 100, bias);
    EXPECT_LT(bias, cells == 3 ? 0.02 : 0.002);
    EXPECT_GT(d.texels, 3000u);
    EXPECT_LT(d.worst, test::zThreshold(d.texels)) << cells << " cells";
    EXPECT_LT(d.ofMean, 4) << cells << " cells";
  }
}

/// With albedo a, light leaves about ns and what would go through the facet is lost: of light scattered about ns at an
/// angle δ to n the lune of (1 − cos δ)/2, and what Veach's factor |wo·n|/|wo·ns| ≤ 4 clamps is of the order of the
/// store's bias. Each bounce keeps at least 1 − η, so radiance is Le·Σ aᵏ(1 − η)ᵏ or more: too little by at most
/// a·η/(1 − a) in relative terms.
TEST(SmoothSphere, OfAlbedoAHalfKeepsTheFurnaceWithinItsFacets) {
  SceneBuilder s;
  const auto wall = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  s.addBox({-1, -1, -1}, {1, 1, 1}, wall, true);
  const auto ball = s.addDiffuse(Rgb(0.5f), Rgb(100.f));
  test::addSphere(s, {0.1, -0.05, 0.15}, 0.7, ball, 12);
  Scene scene = s.build();
  test::smoothen(scene, ball, {0.1, -0.05, 0.15});
  const BakedScene b(scene, test::quickOptions(1'000'000, 10));
  const double sine = test::largestFacetSine(scene, ball);
  const double eta = facetBias(sine) * 2 + (1 - std::sqrt(1 - sine * sine)) / 2;
  const test::Deviation d = deviationFrom(b, kPi64 * 200, eta + facetBias(sine));
  EXPECT_LT(eta, 0.008);
  EXPECT_LT(d.worst, test::zThreshold(d.texels));
  EXPECT_LT(d.ofMean, 4);
  EXPECT_GT(b.baked.ledger.clampedNormals, 0u);
}

TEST(SmoothSphere, UnderTheSunShowsNoFacets) {
  SceneBuilder s;
  const auto ball = s.addDiffuse(Rgb(0.f));
  test::addSphere(s, {0, 0, 0}, 1, ball, 4);  // flat, its facets would be 10 to 40 % off
  Light l;
  l.kind = LightKind::directional;
  l.direction = normalize(Vec3d{-0.3, -1, -0.4});
  l.intensity = Rgb(1000.f);
  s.addLight(l);
  Scene scene = s.build();
  test::smoothen(scene, ball, {});
  const BakedScene b(scene, test::quickOptions(2'000'000, 20));
  const ProbedBake probe(b, "smooth_sphere");
  double worst = 0;
  int questions = 0;
  for (int i = 0; i < 300; ++i) {
    const double z = (i + 0.5) / 300, phi = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    const Frame<double> frame(-l.direction);
    const Vec3d n = frame.toWorld({r * std::cos(phi), r * std::sin(phi), z});
    if (z < 0.35) continue;                        // facets turn away before the sphere does
    const ProbeAnswer a = probe.at(n * 0.975, n);  // the facets are 0 to 0.05 below the sphere
    ASSERT_TRUE(a.onSurface) << i;
    // E = 1000·z changes by 1000 a radian at most. A kernel cut by its chart's edge is off by up to a texel of 1/20,
    // which subtends 1/cos 20° more where the facet sinks below the sphere; the foot of the question is off by
    // 0.025·sin 20°.
    const double bias = 1000 * (0.05 * 1.07 + 0.009);
    worst = std::max(worst, (std::abs(a.irradiance.y - 1000 * z) - bias) / (a.relativeError * 1000 * z));
    ++questions;
  }
  EXPECT_GT(questions, 190);
  EXPECT_LT(worst, test::zThreshold(300));
}

}  // namespace
}  // namespace lucarne::extremes_maps_test
