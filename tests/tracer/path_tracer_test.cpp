// The path tracer against closed forms that know no photons.
#include "tracer/transport/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/textures.h"
#include "tests/tracer/environment_maps.h"
#include "tests/tracer/photon_runs.h"
#include "tracer/optics/bsdf.h"

namespace lucarne::path_tracer_test {
namespace {

using test::Mean;
using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;

/// Many samples of the irradiance of a place, mean over channels.
Mean irradiance(const PhotonScene& scene, const Receiver& at, std::uint64_t samples) {
  const PathTracer paths(scene);
  Mean result;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const ReceivedLight light = paths.receive(at, PhotonSampler(21, i));
    double sum = 0;
    for (std::size_t k = 0; k < light.count; ++k) sum += static_cast<double>(mean(light.pieces[k].lux));
    result.add(sum);
  }
  return result;
}

Mean radianceAlong(const PhotonScene& scene, Vec3d from, Vec3d direction, std::uint64_t samples) {
  const PathTracer paths(scene);
  const RayStart ray{Vec3f(scene.scene().frame.toLocal(from)), Vec3f(normalize(direction)), kNone};
  Mean result;
  for (std::uint64_t i = 0; i < samples; ++i)
    result.add(static_cast<double>(mean(paths.radiance(ray, PhotonSampler(22, i)))));
  return result;
}

TEST(PathTracer, FurnaceHasTheRadianceOfItsSeries) {
  for (const float albedo : {0.f, 0.5f, 0.8f}) {
    SceneBuilder b;
    b.addBox({0, 0, 0}, {2, 1, 3}, b.addDiffuse(Rgb(albedo), Rgb(3.f)), true);
    const Scene scene = b.build();
    const PhotonScene photons(scene);
    const double expected = 3 / (1 - static_cast<double>(albedo));
    const double slack = 1e-5 * expected;
    test::expectMean(radianceAlong(photons, {0.7, 0.4, 1.1}, {0.3, 0.8, -0.5}, 20'000), expected, 6, slack);
    test::expectMean(irradiance(photons, receiverAt(photons, 5, {0.2f, 0.3f}, false), 20'000), kPi64 * expected, 6,
                     slack);
  }
}

TEST(PathTracer, ABulbOverAPlaneHasNoNoise) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
  b.addLight(test::bulbLight({0.3, 1.5, -0.4}, Rgb(120.f)));
  const Scene scene = b.build();
  const PhotonScene photons(scene);
  for (const Vec2f bary : {Vec2f{0.2f, 0.3f}, Vec2f{0.5f, 0.1f}, Vec2f{0.05f, 0.9f}}) {
    const Receiver at = receiverAt(photons, 1, bary, false);
    const Vec3d d = Vec3d{0.3, 1.5, -0.4} - scene.frame.toWorld(at.hit.position);
    const Mean light = irradiance(photons, at, 50);
    const double expected = 120 * d.y / std::pow(dot(d, d), 1.5);
    EXPECT_NEAR(light.mean(), expected, 1e-5 * expected);
    EXPECT_LT(light.error(), 1e-6 * expected);
    EXPECT_EQ(irradiance(photons, receiverAt(photons, 1, bary, true), 50).sum, 0) << "its back is dark";
  }
}

TEST(PathTracer, ASpotAndASunHaveNoNoiseEither) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
  const Scene empty = b.build();
  Light spot = test::bulbLight({0, 2, 0}, Rgb(120.f));
  spot.kind = LightKind::spot;
  spot.direction = {0, -1, 0};
  spot.cosInner = 0.99;
  spot.cosOuter = 0.9;
  SceneBuilder withSpot = b, withSun = b;
  withSpot.addLight(spot);
  withSun.addLight(test::sunLight({1, -2, 0.5}, Rgb(700.f)));
  const Scene spotScene = withSpot.build(), sunScene = withSun.build();
  const PhotonScene spotPhotons(spotScene), sunPhotons(sunScene);
  const Receiver at = receiverAt(spotPhotons, 1, {0.3f, 0.2f}, false);
  const Vec3d d = Vec3d{0, 2, 0} - spotScene.frame.toWorld(at.hit.position);
  const double c = d.y / length(d), falloff = std::clamp((c - 0.9) / 0.09, 0.0, 1.0);
  ASSERT_GT(falloff, 0);
  ASSERT_LT(falloff, 1);
  const double expected = 120 * falloff * falloff * c / dot(d, d);
  EXPECT_NEAR(irradiance(spotPhotons, at, 20).mean(), expected, 1e-5 * expected);
  const double sun = 700 * 2 / std::sqrt(1 + 4 + 0.25);
  EXPECT_NEAR(irradiance(sunPhotons, receiverAt(sunPhotons, 0, {0.3f, 0.2f}, false), 20).mean(), sun, 1e-5 * sun);
}

/// Of the rectangle a × b at height h over a point below one of its corners, parallel to the point's plane (Howell,
/// catalogue of configuration factors, B-3).
double cornerFactor(double a, double b, double h) {
  const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * kPi64);
}

/// A lamp of 2·half square over the middle of a plate.
Scene lampOver(double half, double height, bool doubleSided, bool textured) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
  Material m = test::diffuseMaterial(Rgb(0.f), Rgb(10.f));
  m.doubleSided = doubleSided;
  const auto lamp = b.addMaterial(m);
  b.addQuad({-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}, lamp);
  Scene s = b.build();
  if (textured) {  // the half with u < ½ is dark, x < 0
    s.materials[lamp].emissiveTexture = test::addTexture(
        s, 64,
        [](int x, int) {
          return x < 32 ? std::array<std::uint8_t, 4>{0, 0, 0, 255} : std::array<std::uint8_t, 4>{255, 255, 255, 255};
        },
        true);
  }
  return s;
}

// From a lamp that only next-event estimation finds to one that only the BSDF does well: right at both ends only if
// the weights of the two add up to one.
TEST(PathTracer, RectanglesGiveTheirFormFactor) {
  for (const double half : {0.01, 0.3, 2.0, 100.0})
    for (const bool doubleSided : {false, true}) {
      const double height = 0.4;
      const Scene scene = lampOver(half, height, doubleSided, false);
      const PhotonScene photons(scene);
      const double expected = kPi64 * 10 * 4 * cornerFactor(half, half, height);
      const Mean light = irradiance(photons, receiverAt(photons, 0, {0.f, 0.5f}, false), 40'000);
      test::expectMean(light, expected, 8, 1e-5 * expected);
      EXPECT_LT(light.error(), 0.02 * expected) << "neither way alone is this good";
    }
}

TEST(PathTracer, APaintedLampGivesTheFormFactorOfItsBrightHalf) {
  for (const double half : {0.3, 5.0}) {
    const Scene scene = lampOver(half, 0.4, false, true);
    const PhotonScene photons(scene);
    const double expected = kPi64 * 10 * 2 * cornerFactor(half, half, 0.4);
    test::expectMean(irradiance(photons, receiverAt(photons, 0, {0.f, 0.5f}, false), 40'000), expected, 2,
                     1e-5 * expected);
  }
}

Scene grayPlate(const Material& m) {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addMaterial(m));
  return b.build();
}

TEST(PathTracer, AWhiteSkyGivesPiTimesItsRadiance) {
  const Environment sky(test::constantMap(16, 8, Rgb(50.f)), "white");
  const Scene scene = grayPlate(test::diffuseMaterial(Rgb(0.5f)));
  const PhotonScene photons(scene, {}, &sky);
  test::expectMean(irradiance(photons, receiverAt(photons, 0, {0.3f, 0.3f}, false), 20'000), kPi64 * 50, 1, 1e-3);
}

TEST(PathTracer, ASunOfOnePixelGivesItsRadianceTimesItsSolidAngle) {
  ImageRgb image = test::constantMap(64, 32, Rgb(0.f));
  image.pixels[test::sunPixel(64, 32)] = Rgb(1e5f);
  const Environment sky(std::move(image), "sun");
  const Scene scene = grayPlate(test::diffuseMaterial(Rgb(0.5f)));
  const PhotonScene photons(scene, {}, &sky);
  const auto sine2 = [](int row) { return std::pow(std::sin(kPi64 * row / 32), 2); };
  const double expected = 1e5 * 0.5 * (sine2(32 / 3 + 1) - sine2(32 / 3)) * 2 * kPi64 / 64;
  const Mean light = irradiance(photons, receiverAt(photons, 0, {0.3f, 0.3f}, false), 20'000);
  test::expectMean(light, expected, 1, 1e-5 * expected);
  EXPECT_LT(light.error(), 0.01 * expected);
}

TEST(PathTracer, SkyAndLampsAddUp) {
  const Environment sky(test::constantMap(16, 8, Rgb(5.f)), "white");
  const Scene scene = lampOver(0.3, 0.4, true, false);
  const PhotonScene photons(scene, {}, &sky);
  const double lamp = 4 * cornerFactor(0.3, 0.3, 0.4), expected = kPi64 * (10 * lamp + 5 * (1 - lamp));
  test::expectMean(irradiance(photons, receiverAt(photons, 0, {0.f, 0.5f}, false), 40'000), expected, 1,
                   1e-5 * expected);
}

// Under a white sky every surface shows its albedo.
TEST(PathTracer, UnderAWhiteSkyASurfaceShowsItsAlbedo) {
  const Environment sky(test::constantMap(16, 8, Rgb(1.f)), "white");
  std::vector<Material> materials{test::diffuseMaterial(Rgb(0.6f))};
  for (const float roughness : {0.2f, 0.7f})
    for (const float metallic : {0.f, 1.f}) {
      Material m = test::diffuseMaterial({0.8f, 0.5f, 0.3f});
      m.specular = 1;
      m.roughness = roughness;
      m.metallic = metallic;
      materials.push_back(m);
    }
  for (const Material& m : materials) {
    const Scene scene = grayPlate(m);
    const PhotonScene photons(scene, {}, &sky);
    for (const Vec3d& down : {Vec3d{0.1, -1, 0.05}, Vec3d{1, -0.5, 0.3}}) {
      const Vec3d d = normalize(down);
      const auto cosine = static_cast<float>(-d.y);
      const Rgb a = albedo(makeBsdf(m, factorsOf(m)), {std::sqrt(1 - cosine * cosine), 0, cosine});
      test::expectMean(radianceAlong(photons, Vec3d{0.1, 0, 0.2} - d * 0.5, d, 20'000), static_cast<double>(mean(a)),
                       10, 2e-3);  // the albedo of coats is a table
    }
  }
}

TEST(PathTracer, SeesLampsFromTheirLitSideOnly) {
  const Scene scene = lampOver(0.5, 0.4, false, false);
  const PhotonScene photons(scene);
  EXPECT_EQ(radianceAlong(photons, {0.1, 0.1, 0.1}, {0, 1, 0}, 10).mean(), 10);
  EXPECT_EQ(radianceAlong(photons, {0.1, 1, 0.1}, {0, -1, 0}, 10).mean(), 0);
  const Scene both = lampOver(0.5, 0.4, true, false);
  const PhotonScene bothPhotons(both);
  EXPECT_EQ(radianceAlong(bothPhotons, {0.1, 1, 0.1}, {0, -1, 0}, 10).mean(), 10);
}

TEST(PathTracer, DropsLightBeyondItsDepth) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, {2, 1, 3}, b.addDiffuse(Rgb(0.5f), Rgb(3.f)), true);
  const Scene scene = b.build();
  const PhotonScene photons(scene);
  for (const std::uint32_t depth : {0u, 1u, 3u}) {
    const PathTracer paths(photons, {depth});
    Mean light;
    for (std::uint64_t i = 0; i < 20'000; ++i)
      light.add(static_cast<double>(
          paths.radiance({Vec3f(scene.frame.toLocal({1, 0.5, 1})), {0, 1, 0}, kNone}, PhotonSampler(22, i)).x));
    test::expectMean(light, 6 * (1 - std::pow(0.5, depth + 1)), 3, 1e-5);
  }
}

}  // namespace
}  // namespace lucarne::path_tracer_test
