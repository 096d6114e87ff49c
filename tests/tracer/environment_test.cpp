#include "base/math.h"
#include "tracer/optics/environment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <limits>
#include <random>
#include <set>

#include "base/error.h"
#include "base/float_mode.h"
#include "tests/support/statistics.h"
#include "tests/tracer/environment_maps.h"

namespace lucarne::environment_test {
namespace {

using test::constantMap;
using test::sunMap;


Vec3f unit(double x, double y, double z) { return Vec3f(normalize(Vec3d(x, y, z))); }

/// A map whose pixel (column, row) is (column, row, 1).
ImageRgb coordinateMap(int width, int height) {
  ImageRgb image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.emplace_back(static_cast<float>(x), static_cast<float>(y), 1.f);
  return image;
}

TEST(Environment, TopRowIsUpCentreColumnIsXAndColumnsTurnTowardZ) {
  const Environment e(coordinateMap(8, 4), "map");
  const float low = -0.1f, high = 0.1f;  // a little off the borders between pixels
  EXPECT_EQ(e.radiance(unit(2e-3, 1, 1e-3)), Rgb(4, 0, 1));
  EXPECT_EQ(e.radiance(unit(2e-3, -1, 1e-3)), Rgb(4, 3, 1));
  EXPECT_EQ(e.radiance(unit(1, high, high)), Rgb(4, 1, 1));
  EXPECT_EQ(e.radiance(unit(1, low, low)), Rgb(3, 2, 1));
  EXPECT_EQ(e.radiance(unit(low, high, 1)), Rgb(6, 1, 1));
  EXPECT_EQ(e.radiance(unit(high, high, 1)), Rgb(5, 1, 1));
  EXPECT_EQ(e.radiance(unit(-1, high, high)), Rgb(7, 1, 1));
  EXPECT_EQ(e.radiance(unit(-1, high, low)), Rgb(0, 1, 1));
  EXPECT_EQ(e.radiance(unit(low, high, -1)), Rgb(1, 1, 1));
}

TEST(Environment, AnyDirectionFindsAPixel) {
  const Environment e(coordinateMap(7, 5), "map");
  for (const float x : {-1.f, -0.f, 0.f, 1.f})
    for (const float y : {-1.f, -0.f, 0.f, 1.f})
      for (const float z : {-1.f, -0.f, 0.f, 1.f}) EXPECT_EQ(e.radiance(normalize(Vec3f(x, y, z))).z, 1);
}

/// Samples of the map, some at the ends of the range, where a pixel's borders are nearest.
void expectSamplesInTheirPixels(const Environment& e) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double u = i % 5 == 0 ? 0 : i % 5 == 1 ? 1 - 0x1p-53 : number(random);
    const double v = i % 7 == 0 ? 0 : i % 7 == 1 ? 1 - 0x1p-53 : number(random);
    const Environment::Sample s = e.sample(u, v);
    ASSERT_NEAR(length(s.direction), 1, 2e-7);
    ASSERT_EQ(s.radiance, e.radiance(s.direction)) << e.name() << " at " << u << ", " << v;
    ASSERT_EQ(s.radiance, e.radiance(normalize(s.direction))) << e.name() << " at " << u << ", " << v;
    ASSERT_EQ(s.pdf, e.pdf(s.direction));
  }
}

TEST(Environment, SampledDirectionsLieInThePixelThatWasChosen) {
  for (const auto& [width, height] : {std::pair{64, 32}, {8192, 3}, {3, 4096}, {1, 1}, {1, 1000}, {1000, 1}, {7, 5}})
    expectSamplesInTheirPixels(Environment(coordinateMap(width, height), std::to_string(width) + " columns"));
}

TEST(Environment, SampledDirectionsLieInTheirPixelsAtThePolesOfAFineMap) {
  ImageRgb map = coordinateMap(5, 4096);
  std::fill(map.pixels.begin() + 5 * 6, map.pixels.end() - 5 * 6, Rgb(0));
  expectSamplesInTheirPixels(Environment(map, "poles"));
}

TEST(Environment, ColumnsGrowWithUAndRowsWithV) {
  const Environment e(sunMap(37, 19), "map");
  for (const double fixed : {0.0, 0.3, 0.77, 0.999}) {
    double azimuth = -10, height = 10;
    for (int i = 0; i < 5000; ++i) {
      const Vec3f across = e.sample(i / 5000.0, fixed).direction, down = e.sample(fixed, i / 5000.0).direction;
      const double a = std::atan2(across.z, across.x);
      ASSERT_GE(a, azimuth - 2e-7);
      ASSERT_LE(down.y, height + 2e-7f);
      azimuth = a;
      height = down.y;
    }
  }
}

TEST(Environment, TheSunsPixelGivesManyDirectionsAndItsExactFlux) {
  for (const double peak : {1e5, 1e7}) {
    const ImageRgb map = sunMap(512, 256, peak);
    const Environment e(map, "map");
    const std::size_t sun = test::sunPixel(512, 256);
    const double omega = e.pixelSolidAngle(static_cast<int>(sun / 512));
    const double share = e.pdf(e.sample(0.5, 0.5).direction) * omega;  // the median direction is in the sun
    EXPECT_NEAR(share, mean(Rgbd(map.pixels[sun])) * omega / mean(e.scalarIrradiance()), 1e-12);
    ASSERT_GT(share, 0.4);
    std::set<std::pair<float, float>> seen;
    int hits = 0;
    constexpr int n = 300;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Environment::Sample s = e.sample((i + 0.5) / n, (j + 0.5) / n);
        if (s.radiance != map.pixels[sun]) continue;
        ++hits;
        seen.insert({s.direction.x, s.direction.z});
      }
    // The sun takes one rectangle of the (u, v) square, whose border crosses at most 4n of the cells.
    EXPECT_NEAR(hits, share * n * n, 4 * n);
    EXPECT_GT(seen.size(), 0.99 * hits);
  }
}

TEST(Environment, PdfIsProportionalToTheMeanOfTheChannels) {
  const ImageRgb map = sunMap(20, 10);
  const Environment e(map, "map");
  const double scale = 1 / mean(e.scalarIrradiance());
  double integral = 0;
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x) {
      const Vec3f w = test::pixelCentre(x, y, 20, 10);
      const double value = mean(Rgbd(map.pixels[static_cast<std::size_t>(y * 20 + x)]));
      ASSERT_NEAR(e.pdf(w), value * scale, 1e-12 * value * scale);
      integral += e.pdf(w) * e.pixelSolidAngle(y);
    }
  EXPECT_NEAR(integral, 1, 1e-12);
}

TEST(Environment, ConstantMapsGiveTheSphere) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 1000}, {1000, 1}, {64, 32}}) {
    const Environment e(constantMap(width, height, Rgb(1, 2, 6)), "map");
    double omega = 0;
    for (int y = 0; y < height; ++y) omega += width * e.pixelSolidAngle(y);
    EXPECT_NEAR(omega, 4 * kPiD, 1e-12);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(e.scalarIrradiance()[c], 4 * kPiD * Rgbd(1, 2, 6)[c], 1e-10);
      EXPECT_NEAR(e.meanRadiance()[c], Rgbd(1, 2, 6)[c], 1e-11);
    }
    EXPECT_NEAR(e.pdf(unit(1, 2, 3)), 1 / (4 * kPiD), 1e-13);
    EXPECT_EQ(e.strayPixels(), 0u);
  }
}

TEST(Environment, BlackMapsSayThatTheyAreBlack) {
  const Environment e(constantMap(8, 4, Rgb(0)), "map");
  EXPECT_TRUE(e.isBlack());
  EXPECT_EQ(e.pdf(unit(1, 2, 3)), 0);
  EXPECT_EQ(e.scalarIrradiance(), Rgbd(0));
  EXPECT_THROW(e.sample(0.5, 0.5), std::logic_error);
  EXPECT_FALSE(Environment(sunMap(8, 4), "map").isBlack());
}

TEST(Environment, BlackPixelsAreNeverChosen) {
  ImageRgb map = constantMap(9, 7, Rgb(0));
  map.pixels[9 * 3 + 4] = Rgb(0, 0, 1e-30f);
  map.pixels[9 * 5 + 8] = Rgb(2, 0, 0);
  const Environment e(map, "map");
  for (int i = 0; i <= 1000; ++i) EXPECT_GT(e.sample(std::min(i / 1000.0, 1 - 0x1p-53), 1 - i / 1001.0 - 1e-9).pdf, 0);
}

TEST(Environment, StrayPixelsAreCountedAndReplaced) {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const ImageRgb map{5, 1, {Rgb(1, nan, 3), Rgb(infinity, 5, -infinity), Rgb(-2, 0, 0), Rgb(7, 4, 4), Rgb(0)}};
  const Environment e(map, "map");
  EXPECT_EQ(e.strayPixels(), 3u);
  EXPECT_EQ(e.image().pixels, (std::vector<Rgb>{Rgb(1, 0, 3), Rgb(7, 5, 0), Rgb(0), Rgb(7, 4, 4), Rgb(0)}));
  EXPECT_TRUE(Environment(constantMap(2, 1, Rgb(infinity)), "map").isBlack());
}

TEST(Environment, NoPixelsIsAnInputErrorThatNamesTheMap) {
  for (const auto& [width, height] : {std::pair{0, 0}, {0, 5}, {5, 0}, {-1, -1}}) {
    try {
      const Environment e({width, height, {}}, "sky.hdr");
      ADD_FAILURE() << width << " x " << height;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("sky.hdr"), std::string::npos);
    }
  }
  EXPECT_THROW(Environment({2, 2, {Rgb(1)}}, "sky.hdr"), std::logic_error);
}

TEST(Environment, TheSameBitsForAnyNumberOfThreadsAndFloatMode) {
  ImageRgb map = sunMap(333, 111);
  map.pixels[5] = Rgb(1e-40f, -1e-40f, 1);  // denormal
  const auto summary = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Environment e(map, "map");
    std::vector<double> numbers{mean(e.scalarIrradiance()), static_cast<double>(e.strayPixels())};
    for (int i = 0; i < 1000; ++i) {
      const Environment::Sample s = e.sample(i / 1000.0, i * 7 % 1000 / 1000.0);
      numbers.insert(numbers.end(), {s.direction.x, s.direction.y, s.direction.z, s.pdf});
    }
    return std::pair(numbers, e.contentHash());
  };
  const auto one = summary(1);
  EXPECT_EQ(one, summary(4));
  const FlushDenormals flushed;
  EXPECT_EQ(one, summary(1));
}

TEST(Environment, TheHashIsOfTheSizeAndThePixels) {
  const auto hash = [](const ImageRgb& map) { return Environment(map, "map").contentHash(); };
  ImageRgb map = constantMap(4, 2, Rgb(1));
  EXPECT_EQ(hash(map), hash(constantMap(4, 2, Rgb(1))));
  EXPECT_NE(hash(map), hash(constantMap(2, 4, Rgb(1))));
  map.pixels[3].z = 1.0000001f;
  EXPECT_NE(hash(map), hash(constantMap(4, 2, Rgb(1))));
}

TEST(Environment, RealMapsWithNanAndInfinityAreMended) {
  const std::filesystem::path path = LUCARNE_SOURCE_DIR "/../shared/assets/env/bright_rings_nan_inf.exr";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "shared/assets/env/bright_rings_nan_inf.exr is not here";
  const Environment e(readExrRgb(path), path.string());
  EXPECT_GT(e.strayPixels(), 0u);
  EXPECT_LT(e.strayPixels(), e.image().pixels.size() / 10);
  EXPECT_TRUE(isFinite(e.scalarIrradiance()));
  EXPECT_FALSE(e.isBlack());
  for (int i = 0; i < 1000; ++i) {
    const Environment::Sample s = e.sample(i / 1000.0, i * 7 % 1000 / 1000.0);
    ASSERT_GT(s.pdf, 0);
    ASSERT_TRUE(isFinite(s.radiance));
  }
}

}  // namespace
}  // namespace lucarne::environment_test
