#include "base/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "base/flip_colour.h"

namespace lucarne::flip_test {
namespace {

ImageRgb picture(int width, int height, const std::function<Rgb(int, int)>& at) {
  ImageRgb image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.pixels.push_back(at(x, y));
  }
  return image;
}

ImageRgb uniformPicture(Rgb colour, int size = 24) {
  return picture(size, size, [&](int, int) { return colour; });
}

ImageRgb noise(int width, int height, unsigned seed, float largest = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> u(0, largest);
  return picture(width, height, [&](int, int) { return Rgb{u(random), u(random), u(random)}; });
}

// The paper word by word, in double, with filters of two dimensions: slow, and written apart from the program's own.
class PaperFlip {
 public:
  explicit PaperFlip(double ppd) : ppd_(ppd) {}

  std::vector<double> errors(const ImageRgb& a, const ImageRgb& b) const {
    const View va = view(a), vb = view(b);
    const double green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    const double cmax = std::pow(distance(lab(green), lab(blue)), 0.7), knee = 0.4 * cmax;
    std::vector<double> result;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const double d = std::pow(distance(va.colour[i], vb.colour[i]), 0.7);
      const double c = d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (cmax - knee) * 0.05;
      const double f =
          std::sqrt(std::max(std::abs(va.edge[i] - vb.edge[i]), std::abs(va.point[i] - vb.point[i])) / std::sqrt(2.));
      result.push_back(std::pow(c, 1 - f));
    }
    return result;
  }

 private:
  using Colour = std::array<double, 3>;
  using Channel = std::vector<double>;
  struct Kernel {
    int radius;
    std::vector<double> weights;
  };
  struct View {
    std::vector<Colour> colour;
    Channel edge, point;
  };

  static Colour xyz(const double c[3]) {
    return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794 / 0.950428545,
            (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
            (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382 / 1.088900371};
  }
  static Colour rgb(Colour c) {
    const double y = (c[0] + 16) / 116, X = (y + c[1] / 500) * 0.950428545, Z = (y - c[2] / 200) * 1.088900371;
    return {3.241003275 * X - 1.537398934 * y - 0.498615861 * Z, -0.969224334 * X + 1.875930071 * y + 0.041554224 * Z,
            0.055639423 * X - 0.204011202 * y + 1.057148933 * Z};
  }
  static Colour lab(const double c[3]) {
    Colour t = xyz(c);
    for (double& v : t) v = v > std::pow(6. / 29, 3) ? std::cbrt(v) : v * 841 / 108 + 4. / 29;
    const double L = 116 * t[1] - 16;
    return {L, 0.01 * L * 500 * (t[0] - t[1]), 0.01 * L * 200 * (t[1] - t[2])};
  }
  static double distance(Colour a, Colour b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

  Kernel kernel(int radius, const std::function<double(int, int)>& at, bool balanced) const {
    Kernel k{radius, {}};
    double positive = 0, negative = 0;
    for (int y = -radius; y <= radius; ++y) {
      for (int x = -radius; x <= radius; ++x) {
        k.weights.push_back(at(x, y));
        (k.weights.back() > 0 ? positive : negative) += std::abs(k.weights.back());
      }
    }
    for (double& w : k.weights) w /= !balanced || w > 0 ? positive : negative;
    return k;
  }
  static Channel filtered(const Channel& in, int width, int height, const Kernel& k) {
    Channel out;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        std::size_t i = 0;
        for (int dy = -k.radius; dy <= k.radius; ++dy) {
          for (int dx = -k.radius; dx <= k.radius; ++dx, ++i) {
            const int px = std::clamp(x + dx, 0, width - 1), py = std::clamp(y + dy, 0, height - 1);
            sum += k.weights[i] * in[static_cast<std::size_t>(py * width + px)];
          }
        }
        out.push_back(sum);
      }
    }
    return out;
  }

  View view(const ImageRgb& image) const {
    const int w = image.width, h = image.height;
    std::array<Channel, 3> opponent;
    Channel normalised;
    for (const Rgb& p : image.pixels) {
      const double c[3] = {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
      const Colour t = xyz(c);
      opponent[0].push_back(116 * t[1] - 16);
      opponent[1].push_back(500 * (t[0] - t[1]));
      opponent[2].push_back(200 * (t[1] - t[2]));
      normalised.push_back(t[1]);
    }
    const double pi = std::numbers::pi, a1[3] = {1, 1, 34.1}, b1[3] = {0.0047, 0.0053, 0.04}, a2[3] = {0, 0, 13.5},
                 b2[3] = {1e-5, 1e-5, 0.025};
    const int r = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd_));
    for (std::size_t c = 0; c < 3; ++c) {
      opponent[c] = filtered(opponent[c], w, h,
                             kernel(
                                 r,
                                 [&](int x, int y) {
                                   const double z = (x * x + y * y) / (ppd_ * ppd_);
                                   return a1[c] * std::sqrt(pi / b1[c]) * std::exp(-pi * pi * z / b1[c]) +
                                          a2[c] * std::sqrt(pi / b2[c]) * std::exp(-pi * pi * z / b2[c]);
                                 },
                                 false));
    }
    View v;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      Colour c = rgb({opponent[0][i], opponent[1][i], opponent[2][i]});
      for (double& x : c) x = std::clamp(x, 0., 1.);
      v.colour.push_back(lab(c.data()));
    }
    const double sd = 0.5 * 0.082 * ppd_;
    const int fr = static_cast<int>(std::ceil(3 * sd));
    const auto features = [&](const std::function<double(int, int)>& at) {
      const Channel gx = filtered(normalised, w, h, kernel(fr, at, true));
      const Channel gy = filtered(normalised, w, h,
                                  kernel(
                                      fr, [&](int x, int y) { return at(y, x); }, true));
      Channel out;
      for (std::size_t i = 0; i < gx.size(); ++i) out.push_back(std::hypot(gx[i], gy[i]));
      return out;
    };
    const auto g = [&](int x, int y) { return std::exp(-(x * x + y * y) / (2 * sd * sd)); };
    v.edge = features([&](int x, int y) { return -x * g(x, y); });
    v.point = features([&](int x, int y) { return (x * x / (sd * sd) - 1) * g(x, y); });
    return v;
  }

  double ppd_;
};

TEST(Flip, AgreesWithThePaperWordByWord) {
  const auto card = [](int x, int y) {
    return Rgb{x < 20 ? 0.8f : 0.1f, (y / 4) % 2 ? 0.6f : 0.05f, 0.02f * static_cast<float>(x % 40)};
  };
  const auto shifted = [&](int x, int y) { return card(x + 1, y) * 0.8f; };
  const std::vector<std::pair<ImageRgb, ImageRgb>> pairs = {
      {noise(37, 29, 1), noise(37, 29, 2)},
      {picture(41, 23, card), picture(41, 23, shifted)},
      {picture(70, 5, card), noise(70, 5, 3)},
      {uniformPicture({1, 1, 1}, 1), uniformPicture({1, 0, 0}, 1)}};
  for (const double ppd : {kFlipPixelsPerDegree, 30.}) {
    for (const auto& [a, b] : pairs) {
      const std::vector<double> expected = PaperFlip(ppd).errors(a, b);
      const FlipMap map = flipLdr(a, b, ppd);
      ASSERT_EQ(map.error.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(map.error[i]), expected[i], 2e-4)
            << a.width << "×" << a.height << " pixel " << i;
      }
    }
  }
}

TEST(Flip, IsZeroOfEqualPicturesAndOneOfGreenAgainstBlue) {
  const ImageRgb a = noise(50, 40, 7);
  EXPECT_EQ(flipLdr(a, a).largest(), 0.f);
  EXPECT_EQ(flipHdr(a, a, flipExposures(a)).largest(), 0.f);
  const FlipMap worst = flipLdr(uniformPicture({0, 1, 0}), uniformPicture({0, 0, 1}));
  for (const float e : worst.error) EXPECT_NEAR(e, 1.f, 1e-5f);
}

// No features in uniform pictures: the colour error is all there is. L* 100 against 0.
TEST(Flip, OfBlackAndWhiteIsWhatTheColourMetricSays) {
  const double largest = std::pow(static_cast<double>(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1}))), 0.7);
  EXPECT_NEAR(largest, 41.276, 0.01);  // the paper's largest distance
  const double expected = 0.95 + (std::pow(100, 0.7) - 0.4 * largest) / (0.6 * largest) * 0.05;
  EXPECT_NEAR(flipLdr(uniformPicture(Rgb(0.f)), uniformPicture(Rgb(1.f))).mean(), expected, 1e-4);
}

TEST(Flip, IsTheSameBothWaysRound) {
  const ImageRgb a = noise(33, 31, 11, 40), b = noise(33, 31, 12, 40);
  EXPECT_EQ(flipLdr(a, b).error, flipLdr(b, a).error);
  const FlipExposures exposures = flipExposures(a);
  EXPECT_EQ(flipHdr(a, b, exposures).error, flipHdr(b, a, exposures).error);
}

TEST(Flip, FineNoiseDisturbsLessThanALargePatchOfTheSameDifference) {
  const auto grey = [](int, int) { return Rgb(0.3f); };
  const auto fine = [](int x, int y) { return Rgb((x + y) % 2 ? 0.4f : 0.2f); };
  const auto patch = [](int x, int) { return Rgb(x < 40 ? 0.4f : 0.2f); };
  const ImageRgb reference = picture(80, 80, grey);
  EXPECT_LT(2 * flipLdr(reference, picture(80, 80, fine)).mean(), flipLdr(reference, picture(80, 80, patch)).mean());
}

TEST(Flip, ExposuresBringTheBrightestPixelAndTheMedianToTheSameLight) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    ImageRgb image = noise(40, 40, 5, 1);
    for (Rgb& p : image.pixels) p = p * scale;
    image.pixels[17] = Rgb(300 * scale);
    const FlipExposures e = flipExposures(image);
    EXPECT_NEAR(flipToneCurve(static_cast<float>(std::exp2(e.start)) * 300 * scale), 0.85f, 1e-4f);
    std::vector<float> l;
    for (const Rgb& p : image.pixels) l.push_back(luminance(p));
    std::sort(l.begin(), l.end());
    const float median = 0.5f * (l[799] + l[800]);
    EXPECT_NEAR(flipToneCurve(static_cast<float>(std::exp2(e.stop)) * median), 0.85f, 1e-4f);
    EXPECT_EQ(e.count, static_cast<int>(std::ceil(e.stop - e.start)));
  }
}

TEST(Flip, OfHdrPicturesDoesNotDependOnTheUnit) {
  const ImageRgb a = noise(30, 30, 21, 50), b = noise(30, 30, 22, 50);
  ImageRgb a1000 = a, b1000 = b;
  for (Rgb& p : a1000.pixels) p = p * 1024.f;
  for (Rgb& p : b1000.pixels) p = p * 1024.f;
  EXPECT_NEAR(flipHdr(a, b, flipExposures(a)).mean(), flipHdr(a1000, b1000, flipExposures(a1000)).mean(), 1e-5);
}

// A difference in the dark that one exposure alone does not show.
TEST(Flip, OfHdrPicturesSeesDifferencesInTheDarkAndInTheBright) {
  const auto light = [](float dark, float bright) {
    return picture(60, 60, [=](int x, int) { return Rgb(x < 40 ? dark : bright); });
  };
  const ImageRgb a = light(1, 4000);
  const FlipExposures e = flipExposures(a);
  EXPECT_GE(e.count, 11);
  EXPECT_GT(flipHdr(a, light(2, 4000), e).mean(), 0.05);
  EXPECT_GT(flipHdr(a, light(1, 8000), e).mean(), 0.05);
}

TEST(Flip, StaysFiniteWithBlackHugeAndBrokenPixels) {
  ImageRgb a = noise(20, 20, 31), b = a;
  a.pixels[0] = Rgb(NAN), a.pixels[1] = Rgb(INFINITY), a.pixels[2] = Rgb(3e38f), a.pixels[3] = Rgb(-5.f);
  a.pixels[4] = Rgb(1e-38f);
  for (const ImageRgb& reference : {a, uniformPicture(Rgb(0.f), 20), uniformPicture(Rgb(1e-40f), 20)}) {
    const FlipExposures e = flipExposures(reference);
    EXPECT_TRUE(std::isfinite(e.start) && std::isfinite(e.stop));
    for (const FlipMap& map : {flipHdr(reference, b, e), flipLdr(reference, b)}) {
      for (const float error : map.error) EXPECT_TRUE(error >= 0 && error <= 1) << error;
    }
  }
}

}  // namespace
}  // namespace lucarne::flip_test
