#include "tracer/optics/glass.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/statistics.h"
#include "tests/tracer/glass_cases.h"
#include "tracer/optics/ggx.h"

namespace lucarne::glass_test {
namespace {

using test::atCosine;
using test::flipped;
using test::GlassCase;
using test::glassCases;
using test::glassDirections;
using test::glassRandoms;
using test::Mean;
using test::other;

/// Bins of the whole sphere: one set of polar bins for each hemisphere, about the mean direction of what goes there and
/// dense on the scale of its spread: r = tan(angle/2) = scale · t/(1−t), t in [0, 1).
class LobeBins {
 public:
  LobeBins(const Glass& g, Vec3f wi) {
    for (const int side : {0, 1}) {
      std::vector<Vec3d> there;
      Vec3d sum{0, 0, side == 1 ? -1e-9 : 1e-9};
      for (std::uint64_t i = 0; i < 2000; ++i) {
        const auto s = sample(g, wi, glassRandoms(14, i), Transport::flux);
        if (!s || (s->wo.z < 0) != (side == 1)) continue;
        there.push_back(Vec3d(s->wo));
        sum += there.back();
      }
      about_[side] = Frame<double>(normalize(sum));
      double spread = 0;
      for (const Vec3d& w : there) spread += halfTangent(about_[side].toLocal(w)) / static_cast<double>(there.size());
      scale_[side] = there.size() < 50 ? 0.5 : spread;
    }
  }

  std::size_t binOf(Vec3f w) const {
    const int side = w.z < 0;
    const Vec3d v = about_[side].toLocal(Vec3d(w));
    const double r = halfTangent(v);
    const double t = r / (r + scale_[side]), turns = std::atan2(v.y, v.x) / (2 * std::numbers::pi) + 0.5;
    const auto i = std::min(kPolar - 1, static_cast<std::size_t>(t * kPolar));
    const auto j = std::min(kAzimuth - 1, static_cast<std::size_t>(turns * kAzimuth));
    return (static_cast<std::size_t>(side) * kPolar + i) * kAzimuth + j;
  }

  /// ∫ density over each bin, and last what is left to 1: the probability of no sample. Midpoint rule; cells on the
  /// horizon, where the density jumps, are divided.
  template <class F>
  std::vector<double> integrate(F&& density) const {
    constexpr std::size_t sub = 24, fine = 7;
    constexpr double dt = 1.0 / (kPolar * sub), du = 1.0 / (kAzimuth * sub);
    std::vector<double> bins(kBins + 1, 0);
    double all = 0;
    for (const int side : {0, 1})
      for (std::size_t i = 0; i < kPolar * sub; ++i)
        for (std::size_t j = 0; j < kAzimuth * sub; ++j) {
          const double t = static_cast<double>(i) * dt, u = static_cast<double>(j) * du;
          double part = 0;
          if (const Place mid = place(side, t + dt / 2, u + du / 2); std::abs(mid.w.z) > 2 * mid.size(dt, du)) {
            part = (mid.w.z < 0) == (side == 1) ? density(mid.w) * mid.area * dt * du : 0;
          } else {
            for (std::size_t k = 0; k < fine * fine; ++k) {
              const auto f = [](std::size_t x) { return (static_cast<double>(x) + 0.5) / fine; };
              const Place p = place(side, t + f(k / fine) * dt, u + f(k % fine) * du);
              if ((p.w.z < 0) == (side == 1)) part += density(p.w) * p.area * dt * du / (fine * fine);
            }
          }
          bins[(static_cast<std::size_t>(side) * kPolar + i / sub) * kAzimuth + j / sub] += part;
          all += part;
        }
    bins[kBins] = std::max(1 - all, 1e-12);
    return bins;
  }

  static constexpr std::size_t kPolar = 12, kAzimuth = 16, kBins = 2 * kPolar * kAzimuth;

 private:
  struct Place {
    Vec3f w;
    double area, alongT, alongU;  // solid angle and arcs per dt and du
    float size(double dt, double du) const { return static_cast<float>(alongT * dt + alongU * du); }
  };
  Place place(int side, double t, double u) const {
    const double r = scale_[side] * t / (1 - t), dr = scale_[side] / ((1 - t) * (1 - t)), k = 2 / (1 + r * r);
    const double phi = 2 * std::numbers::pi * (u - 0.5);
    const Vec3d v{r * k * std::cos(phi), r * k * std::sin(phi), k - 1};
    return {Vec3f(about_[side].toWorld(v)), k * k * r * dr * 2 * std::numbers::pi, k * dr,
            k * r * 2 * std::numbers::pi};
  }
  static double halfTangent(Vec3d v) { return std::sqrt(v.x * v.x + v.y * v.y) / std::max(1 + v.z, 1e-12); }

  Frame<double> about_[2]{Frame<double>({0, 0, 1}), Frame<double>({0, 0, -1})};
  double scale_[2];
};

/// p-value of the samples under pdf()^pdfPower; 0 if one of them lies where that is 0.
double samplerP(const Glass& g, Vec3f wi, double pdfPower) {
  constexpr std::uint64_t samples = 100000;
  const LobeBins bins(g, wi);
  std::vector<double> observed(LobeBins::kBins + 1, 0);
  for (std::uint64_t i = 0; i < samples; ++i) {
    const auto s = sample(g, wi, glassRandoms(3, i), Transport::flux);
    if (s && !(pdf(g, wi, s->wo) > 0)) return 0;
    ++observed[s ? bins.binOf(s->wo) : LobeBins::kBins];
  }
  auto expected = bins.integrate([&](Vec3f w) { return std::pow(static_cast<double>(pdf(g, wi, w)), pdfPower); });
  // The midpoint rule may miss the edge of the lobe in a bin that it hardly reaches.
  for (double& e : expected) e = std::max(e * samples, 1e-6);
  return test::chiSquareP(observed, expected);
}

TEST(Glass, SamplesFollowTheirDensityAndTheLostShareIsWhatItLeaves) {
  const auto cases = glassCases({0.001f, 0.05f, 0.3f, 1.f});
  const double significance = 1e-4 / static_cast<double>(cases.size() * glassDirections().size());
  for (const GlassCase& c : cases)
    for (const Vec3f wi : glassDirections())
      EXPECT_GT(samplerP(c.glass(), wi, 1), significance) << c.name() << " cos " << wi.z;
}

// The test of the tester.
TEST(Glass, AWrongDensityIsRejected) {
  EXPECT_LT(samplerP(GlassCase{1.5f, false, false, 0.3f}.glass(), atCosine(0.4f), 1.05), 1e-10);
  EXPECT_LT(samplerP(GlassCase{1.5f, true, false, 0.05f}.glass(), atCosine(0.75f), 1.05), 1e-10);
}

TEST(Glass, TheWeightIsValueTimesCosineOverDensity) {
  for (const GlassCase& c : glassCases({0.001f, 0.02f, 0.3f, 1.f}))
    for (const Vec3f wi : glassDirections())
      for (const Transport transport : {Transport::flux, Transport::radiance})
        for (std::uint64_t i = 0; i < 500; ++i) {
          const auto s = sample(c.glass(), wi, glassRandoms(4, i), transport);
          if (!s) continue;
          const float density = pdf(c.glass(), wi, s->wo);
          EXPECT_NEAR(s->pdf, density, 5e-3f * s->pdf) << c.name() << " cos " << wi.z;
          const Rgb w = evaluate(c.glass(), wi, s->wo, transport) * (std::abs(s->wo.z) / density);
          EXPECT_LT(maxComponent(w - s->weight), 5e-3f * maxComponent(s->weight) + 1e-5f) << c.name() << " " << wi.z;
          EXPECT_GT(minComponent(w - s->weight), -5e-3f * maxComponent(s->weight) - 1e-5f) << c.name() << " " << wi.z;
        }
}

// The white furnace, sample by sample.
TEST(Glass, NoPhotonGrows) {
  for (const GlassCase& c : glassCases({0.001f, 0.02f, 0.3f, 1.f}))
    for (const Vec3f wi : {atCosine(1), atCosine(0.75f), atCosine(0.4f), atCosine(0.05f), atCosine(1e-4f)})
      for (std::uint64_t i = 0; i < 2000; ++i)
        if (const auto s = sample(c.white(), wi, glassRandoms(5, i), Transport::flux)) {
          EXPECT_LE(maxComponent(s->weight), 1 + 1e-5f) << c.name() << " cos " << wi.z;
        }
}

Vec3f anyDirection(Vec3f u) { return directionAround(1 - 1.98f * u.x, u.y); }

// f_radiance'(wo, wi) = f_flux(wi, wo) and f_radiance = f_flux/η² in refraction.
TEST(Glass, IsReciprocalInTheGeneralisedSense) {
  int refracted = 0;
  for (const GlassCase& c : glassCases({0.1f, 0.5f, 1.f}))
    for (std::uint64_t i = 0; i < 3000; ++i) {
      const Glass g = c.glass();
      const Vec3f a = directionAround(0.02f + 0.98f * glassRandoms(6, 2 * i).z, 0.3f);
      const Vec3f b = anyDirection(glassRandoms(6, 2 * i + 1));
      const bool through = b.z < 0;
      const float photon = evaluate(g, a, b, Transport::flux).y;
      const float camera = through ? evaluate(other(g), flipped(b), flipped(a), Transport::radiance).y
                                   : evaluate(g, b, a, Transport::radiance).y;
      EXPECT_NEAR(photon, camera, 2e-3f * photon + 1e-6f) << c.name() << " " << a.z << " " << b.z;
      const float scale = through && !c.thin ? g.eta * g.eta : 1.f;
      EXPECT_NEAR(photon, scale * evaluate(g, a, b, Transport::radiance).y, 1e-5f * photon);
      if (through && photon > 1e-3f) ++refracted;
    }
  EXPECT_GT(refracted, 1000);
}

double light(Vec3f w) { return 1.2 + static_cast<double>(w.x); }
double sensor(Vec3f w) { return 1.1 - static_cast<double>(w.x * w.z) + 0.3 * static_cast<double>(w.y); }

struct Ways {
  Mean photons, camera;
};
/// ∫∫ light(wi) f(wi→wo) sensor(wo) |cos wi| |cos wo| dwi dwo over wo through (or off) the surface: photons start from
/// wi and camera paths from wo.
Ways bothWays(const Glass& g, bool through, Transport ofCamera) {
  Ways ways;
  const Glass seen = through ? other(g) : g;
  const auto turned = [&](Vec3f w) { return through ? flipped(w) : w; };
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const Vec3f u = glassRandoms(7, 2 * i), v = glassRandoms(7, 2 * i + 1);
    const Vec3f start = sampleCosineHemisphere({u.x, u.y});
    const auto photon = sample(g, start, v, Transport::flux);
    const bool passes = photon && (photon->wo.z < 0) == through;
    ways.photons.add(passes ? light(start) * static_cast<double>(photon->weight.y) * sensor(photon->wo) : 0.0);
    const auto path = sample(seen, start, v, ofCamera);
    const bool arrives = path && (path->wo.z < 0) == through;
    ways.camera.add(arrives ? sensor(turned(start)) * static_cast<double>(path->weight.y) * light(turned(path->wo))
                            : 0);
  }
  return ways;
}

TEST(Glass, PhotonsAndCameraPathsMeasureTheSame) {
  const auto cases = glassCases({0.001f, 0.2f, 0.8f});
  const double z = test::zThreshold(2 * cases.size());
  for (const GlassCase& c : cases)
    for (const bool through : {false, true}) {
      const Ways w = bothWays(c.glass(), through, Transport::radiance);
      EXPECT_NEAR(w.photons.mean(), w.camera.mean(), z * std::hypot(w.photons.error(), w.camera.error()))
          << c.name() << (through ? " through" : " off");
    }
}

TEST(Glass, FluxInPlaceOfRadianceIsFound) {
  const Ways w = bothWays(GlassCase{1.1f, false, false, 0.2f}.glass(), true, Transport::flux);
  EXPECT_GT(std::abs(w.photons.mean() - w.camera.mean()), 20 * std::hypot(w.photons.error(), w.camera.error()));
}

double exactFresnel(double c, double eta) {
  const double s2 = (1 - c * c) / (eta * eta);
  if (s2 >= 1) return 1;
  const double t = std::sqrt(1 - s2), s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
  return 0.5 * (s * s + p * p);
}

TEST(Glass, SmoothGlassReflectsFresnelsShareAndRefractsByTheLawOfSnell) {
  constexpr int samples = 50000;
  const auto cases = glassCases({kMinAlpha});
  const double z = test::zThreshold(cases.size() * 3);
  for (const GlassCase& c : cases)
    for (const float cosine : {1.f, 0.97f, 0.5f}) {
      const Vec3f wi = atCosine(cosine);
      const auto eta = static_cast<double>(c.eta());
      Mean reflected;
      Vec3d through{};
      for (std::uint64_t i = 0; i < samples; ++i) {
        const auto s = sample(c.white(), wi, glassRandoms(8, i), Transport::flux);
        reflected.add(s && s->wo.z > 0 ? static_cast<double>(s->weight.y) : 0);
        if (s && s->wo.z < 0) through += Vec3d(s->wo);
      }
      const double f = exactFresnel(static_cast<double>(cosine), eta);
      EXPECT_NEAR(reflected.mean(), f, z * reflected.error() + 2e-4) << c.name() << " cos " << cosine;
      if (f == 1) continue;
      const double bend = c.thin ? 1 : 1 / eta;  // sin θt = sin θi / η, in the plane of wi and the normal
      const Vec3d snell{-static_cast<double>(wi.x) * bend, -static_cast<double>(wi.y) * bend,
                        -std::sqrt(1 - (1 - static_cast<double>(cosine * cosine)) * bend * bend)};
      EXPECT_LT(length(normalize(through) - snell), 1e-3) << c.name() << " cos " << cosine;
    }
}

TEST(Glass, BeyondTheCriticalAngleAllIsReflectedUntinted) {
  for (const float ior : {1.1f, 1.5f, 2.4f}) {
    Glass g = GlassCase{ior, true, false, kMinAlpha}.white();
    g.tint = g.reflectance = Rgb{0.f};
    const float critical = std::sqrt(1 - 1 / (ior * ior));
    for (const float part : {0.3f, 0.6f, 0.9f}) {
      Mean weight;
      for (std::uint64_t i = 0; i < 20000; ++i) {
        const auto s = sample(g, atCosine(part * critical), glassRandoms(9, i), Transport::flux);
        if (s) {
          EXPECT_GT(s->wo.z, 0);
        }
        weight.add(s ? static_cast<double>(s->weight.y) : 0);
      }
      EXPECT_NEAR(weight.mean(), 1, 2e-3) << ior << " " << part;
    }
  }
}

TEST(Glass, WithoutDifferenceOfIndexLightGoesStraightOn) {
  for (const float eta : {1.f, 1.00005f, 1 / 1.00005f})
    for (const float alpha : {0.001f, 0.5f})
      for (const float cosine : {1.f, 0.5f, 0.1f})
        for (std::uint64_t i = 0; i < 1000; ++i) {
          Glass g;
          g.tint = {0.9f, 0.5f, 0.1f};
          g.eta = eta;
          g.alpha = alpha;
          Vec3f u = glassRandoms(10, i);
          u.y *= 0.99f;  // without the far tail of the lobe
          const auto s = sample(g, atCosine(cosine), u, Transport::radiance);
          ASSERT_TRUE(s);
          EXPECT_LT(length(s->wo + atCosine(cosine)), 0.025f);
          EXPECT_LT(maxComponent(g.tint - s->weight), 2e-3f);
          EXPECT_LE(maxComponent(s->weight - g.tint), 1e-6f);
        }
}

TEST(Glass, AnInfiniteIndexReflectsAllByItsReflectance) {
  for (const float eta : {0.f, 1 / 0.f})
    for (std::uint64_t i = 0; i < 1000; ++i) {
      Glass g = GlassCase{1.5f, false, false, 0.01f}.glass();
      g.eta = eta;
      Vec3f u = glassRandoms(11, i);
      u.y *= 0.99f;  // without the far tail of the lobe
      const auto s = sample(g, atCosine(0.7f), u, Transport::flux);
      ASSERT_TRUE(s);
      EXPECT_GT(s->wo.z, 0);
      EXPECT_NEAR(s->weight.y / s->weight.z, g.reflectance.y / g.reflectance.z, 1e-5f);
      EXPECT_GT(pdf(g, atCosine(0.7f), s->wo), 0);
      EXPECT_EQ(evaluate(g, atCosine(0.7f), {0, 0, -1}, Transport::flux), Rgb{});
    }
}

TEST(Glass, BlackGlassGivesNothingBelowTheCriticalAngle) {
  Glass g;
  g.tint = g.reflectance = Rgb{0.f};
  for (std::uint64_t i = 0; i < 100; ++i) EXPECT_FALSE(sample(g, atCosine(0.5f), glassRandoms(12, i), Transport::flux));
  EXPECT_EQ(pdf(g, atCosine(0.5f), atCosine(0.5f)), 0);
}

// Nothing but finite, whatever the arguments.
TEST(Glass, ExtremesStayFinite) {
  for (const float eta : {1e-6f, 1 / 1.0002f, 1.0002f, 1e6f})
    for (const float alpha : {kMinAlpha, 1.f})
      for (const float cosine : {1e-20f, 1e-7f, 1e-3f, 1.f})
        for (std::uint64_t i = 0; i < 500; ++i) {
          Glass g;
          g.eta = eta;
          g.alpha = alpha;
          const Vec3f wi{std::sqrt(1 - cosine * cosine), 0, cosine};
          const auto s = sample(g, wi, glassRandoms(13, i), Transport::flux);
          if (!s) continue;
          EXPECT_TRUE(isFinite(s->weight) && isFinite(s->wo) && std::isfinite(s->pdf)) << eta << " " << cosine;
          EXPECT_NEAR(length(s->wo), 1, 1e-5f);
          EXPECT_TRUE(isFinite(evaluate(g, wi, s->wo, Transport::radiance)) && std::isfinite(pdf(g, wi, s->wo)));
        }
}

}  // namespace
}  // namespace lucarne::glass_test
