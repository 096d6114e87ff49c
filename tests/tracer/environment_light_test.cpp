// Photons from the sky: closed forms of what falls on convex things.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tracer/environment_maps.h"
#include "tests/tracer/photon_runs.h"
#include "tracer/optics/emission_guide.h"

namespace lucarne::environment_light_test {
namespace {

using test::FluxMeter;
using test::SceneBuilder;
constexpr double kPi64 = std::numbers::pi;

Scene blackBox(Vec3d size) {
  SceneBuilder b;
  b.addBox({0, 0, 0}, size, b.addDiffuse(Rgb(0.f)), false);
  return b.build();
}

Scene blackPlate() {
  SceneBuilder b;
  test::addPlate(b, 0, 1, b.addDiffuse(Rgb(0.f)));
  return b.build();
}

double boundingRadius(const Scene& scene) {
  Box box;
  for (const Vec3f& p : scene.positions) box.add(Vec3d(p));
  return 0.5 * length(box.extent()) * scene.frame.scale;
}

TEST(EnvironmentLight, FluxOfAConstantSkyIsTheClosedForm) {
  const Environment sky(test::constantMap(16, 8, {1, 2, 6}), "white");
  for (const Vec3d& size : {Vec3d{1, 1, 1}, Vec3d{3, 1, 0.5}, Vec3d{2000, 10, 10}}) {
    const Scene scene = blackBox(size);
    const PhotonScene photons(scene, {}, &sky);
    const double r = 0.5 * length(size), flux = kPi64 * r * r * 4 * kPi64 * 3;
    EXPECT_NEAR(photons.emitters().totalFlux(), flux, 3e-4 * flux);
  }
}

TEST(EnvironmentLight, AWhiteSkyGivesPiTimesItsRadianceOnEveryFaceOfABox) {
  const Environment sky(test::constantMap(16, 8, Rgb(50.f)), "white");
  const Vec3d size{3, 2, 1};
  const Scene scene = blackBox(size);
  const PhotonScene photons(scene, {}, &sky);
  FluxMeter meter(6, [](const PhotonHit& h) { return h.hit.triangle / 2; });
  const Ledger l = test::fly(photons, 400'000, meter, PhotonSeed(2, SamplerKind::random));
  test::expectBalance(l);
  for (std::size_t face = 0; face < 6; ++face) {
    const int axis = static_cast<int>(face) / 2;
    const double area = size.x * size.y * size.z / size[axis];
    test::expectMean(meter[face], kPi64 * 50 * area / photons.emitters().totalFlux(), 6);
  }
}

/// ∫ cos θ dω over a pixel of the upper half, θ from the vertical: (sin² θ1 − sin² θ0)/2 · Δφ.
double projectedSolidAngle(const Environment& sky, int row) {
  const auto sine2 = [&](int r) { return std::pow(std::sin(kPi64 * r / sky.image().height), 2); };
  return 0.5 * (sine2(row + 1) - sine2(row)) * 2 * kPi64 / sky.image().width;
}

struct PlateLight {
  double sun = 0, all = 0;  // lx, mean over channels
};
PlateLight onPlate(const Environment& sky) {
  PlateLight light;
  const int w = sky.image().width, h = sky.image().height;
  for (int y = 0; y < h / 2; ++y)
    for (int x = 0; x < w; ++x) {
      const auto pixel = static_cast<std::size_t>(y * w + x);
      const double lux = mean(Rgbd(sky.image().pixels[pixel])) * projectedSolidAngle(sky, y);
      light.all += lux;
      if (pixel == test::sunPixel(w, h)) light.sun = lux;
    }
  return light;
}

/// An uneven guide, whether a pilot would find it worth it or not.
void guideSky(PhotonScene& photons) {
  const GuideGrid grid{2, 4};
  std::vector<double> useful(grid.cells(), 0.0);
  for (std::size_t c = 0; c < useful.size(); c += 3) useful[c] = 1 + static_cast<double>(c % 5);
  photons.setGuide(photons.emitters().size() - 1, EmissionGuide(grid, useful));
}

TEST(EnvironmentLight, ASmallStrongSunAndItsSkyFallOnAPlateAsTheyShould) {
  const Environment sky(test::sunMap(64, 32), "sun");
  const Scene scene = blackPlate();
  const PlateLight light = onPlate(sky);
  ASSERT_GT(light.sun, 5 * (light.all - light.sun));
  ASSERT_GT(light.all - light.sun, 1e-5 * light.sun);
  for (const bool guided : {false, true}) {
    PhotonScene photons(scene, {}, &sky);
    if (guided) guideSky(photons);
    const Vec3f toSun = test::pixelCentre(64 / 5, 32 / 3, 64, 32);
    const auto place = [&](const PhotonHit& h) { return dot(h.wi, toSun) > std::cos(0.08f) ? 0 : 1; };
    FluxMeter meter(2, place);
    const Ledger l = test::fly(photons, 200'000, meter, PhotonSeed(3, SamplerKind::random));
    test::expectBalance(l);
    const double flux = photons.emitters().totalFlux(), area = 4;
    test::Mean sum = meter[0];
    sum.sum += meter[1].sum;  // no photon counts twice: the plate is black
    sum.squares += meter[1].squares;
    test::expectMean(sum, area * light.all / flux, 4);
    EXPECT_GT(meter[0].mean() * flux, area * light.sun * 0.98);
  }
}

TEST(EnvironmentLight, NoPhotonOfASunnySkyIsAFirefly) {
  const Environment sky(test::sunMap(64, 32), "sun");
  const Scene scene = blackPlate();
  PhotonScene photons(scene, {}, &sky);
  const auto largest = [&] {
    float most = 0;
    for (std::uint64_t i = 0; i < 200'000; ++i)
      most = std::max(most, maxComponent(photons.emitters().sample(PhotonSampler(8, i).emission()).beta));
    return most;
  };
  EXPECT_LE(largest(), 3.001f) << "one channel of three";
  guideSky(photons);
  EXPECT_LE(largest(), 3 * 4 * 1.001f) << "a guide's density is at least a quarter";
}

TEST(EnvironmentLight, SkyPhotonsCoverTheWholeScene) {
  const Environment sky(test::constantMap(8, 4, Rgb(1.f)), "white");
  const Scene scene = blackBox({5, 1, 1});
  const PhotonScene photons(scene, {}, &sky);
  const double r = boundingRadius(scene) / scene.frame.scale;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const EmittedPhoton p = photons.emitters().sample(PhotonSampler(8, i).emission());
    ASSERT_GE(length(p.position), r) << "starts outside";
    ASSERT_NEAR(dot(p.position, Vec3d(p.direction)), -r, 1e-3 * r);
  }
}

}  // namespace
}  // namespace lucarne::environment_light_test
