#include "base/math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace lucarne::math_test {
namespace {

constexpr long double kPi = 3.141592653589793238462643383279502884L;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double relativeError(double value, long double exact) {
  if (exact == 0) return std::fabs(value);
  return static_cast<double>(std::fabs((static_cast<long double>(value) - exact) / exact));
}

/// Largest of error(x) over `count` x, evenly spaced in [lo, hi] with a random shift each.
template <class Error>
double largestError(double lo, double hi, int count, Error error) {
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> shift(0, 1);
  double largest = 0;
  for (int i = 0; i < count; ++i) {
    const double found = error(lo + (hi - lo) * (i + shift(random)) / count);
    largest = std::isnan(found) ? kInfinity : std::max(largest, found);
  }
  return largest;
}

constexpr int kSamples = 100'000;

TEST(Math, SinPiAndCosPiAgreeWithExtendedPrecision) {
  for (const double range : {1.0, 1000.0}) {
    const auto sine = [](double x) {
      return std::fabs(static_cast<double>(sinPi(x) - std::sin(kPi * std::fmod(static_cast<long double>(x), 2))));
    };
    const auto cosine = [](double x) {
      return std::fabs(static_cast<double>(cosPi(x) - std::cos(kPi * std::fmod(static_cast<long double>(x), 2))));
    };
    EXPECT_LT(largestError(-range, range, kSamples, sine), 3e-16);
    EXPECT_LT(largestError(-range, range, kSamples, cosine), 3e-16);
  }
}

TEST(Math, SinPiAndCosPiAreExactAtQuarterTurnsHoweverLarge) {
  for (const double turns : {0.0, 2.0, -6.0, 1e15, 0x1p53, 1e300}) {
    EXPECT_EQ(sinPi(turns), 0);
    EXPECT_EQ(cosPi(turns), 1);
  }
  EXPECT_EQ(sinPi(0.5), 1);
  EXPECT_EQ(sinPi(-0.5), -1);
  EXPECT_EQ(sinPi(1001.5), -1);
  EXPECT_EQ(cosPi(0.5), 0);
  EXPECT_EQ(cosPi(-1), -1);
  EXPECT_TRUE(std::isnan(sinPi(kInfinity)));
  EXPECT_TRUE(std::isnan(cosPi(std::nan(""))));
}

TEST(Math, SinCosTurnsIsAccurateOverTheWholeTurn) {
  double largest = 0, longest = 0;
  for (int i = 0; i <= 1 << 22; ++i) {
    const float u = static_cast<float>(i) * 0x1p-22f;
    float s = 0, c = 0;
    sinCosTurns(u, s, c);
    const double angle = 2 * static_cast<double>(kPi) * u;
    largest = std::max({largest, std::fabs(s - std::sin(angle)), std::fabs(c - std::cos(angle))});
    longest = std::max(longest, std::fabs(std::sqrt(double{s} * s + double{c} * c) - 1));
  }
  EXPECT_LT(largest, 2e-7);
  EXPECT_LT(longest, 2e-7);
  float s = 0, c = 0;
  sinCosTurns(std::nextafter(1.f, 0.f), s, c);
  EXPECT_NEAR(s, 0, 4e-7);
  EXPECT_NEAR(c, 1, 2e-7);
}

TEST(Math, CbrtAgreesOverTheWholeRange) {
  const auto error = [](double x) { return relativeError(cbrt(x), std::cbrt(static_cast<long double>(x))); };
  EXPECT_LT(largestError(-10, 10, kSamples, error), 4e-16);
  const auto errorOfPower = [&](double e) { return error(std::exp2(e)); };
  EXPECT_LT(largestError(-1070, 1023, kSamples, errorOfPower), 4e-16);
  EXPECT_EQ(cbrt(27), 3);
  EXPECT_EQ(cbrt(-8), -2);
  EXPECT_EQ(cbrt(0), 0);
  EXPECT_EQ(cbrt(kInfinity), kInfinity);
}

TEST(Math, ExpAgreesWithExtendedPrecision) {
  const auto error = [](double x) { return relativeError(exp(x), std::exp(static_cast<long double>(x))); };
  EXPECT_LT(largestError(-1, 1, kSamples, error), 4e-16);
  EXPECT_LT(largestError(-708, 709.7, kSamples, error), 4e-16);
  EXPECT_EQ(exp(0), 1);
  EXPECT_EQ(exp(711), kInfinity);
  EXPECT_EQ(exp(709.9), kInfinity);
  EXPECT_EQ(exp(-kInfinity), 0);
  EXPECT_NEAR(exp(-740) / std::exp(-740.0), 1, 1e-2);  // subnormal
  EXPECT_TRUE(std::isnan(exp(std::nan(""))));
}

TEST(Math, LogAgreesWithExtendedPrecision) {
  const auto error = [](double x) { return relativeError(log(x), std::log(static_cast<long double>(x))); };
  EXPECT_LT(largestError(0.5, 2, kSamples, error), 2.3e-16);
  EXPECT_LT(largestError(-1073, 1023, kSamples, [&](double e) { return error(std::exp2(e)); }), 2.3e-16);
  EXPECT_EQ(log(1), 0);
  EXPECT_EQ(log(0), -kInfinity);
  EXPECT_EQ(log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(log(-1)));
  EXPECT_TRUE(std::isnan(log(std::nan(""))));
}

TEST(Math, PowAgreesWithExtendedPrecision) {
  for (const double y : {2.4, 1 / 2.4, -0.5, 1.0 / 3, 5.0, 20.25, 300.0, -1500.0}) {
    const auto error = [y](double e) {
      const double x = std::exp2(e);
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
      if (exact > 1.7e308L || exact < 2.3e-308L) return 0.0;
      return relativeError(pow(x, y), exact) / (1 + std::fabs(y * std::log(x)));
    };
    EXPECT_LT(largestError(-8, 8, kSamples, error), 4e-16) << y;
  }
  // Large whole powers of two in the result cost nothing.
  EXPECT_LT(relativeError(pow(2, 1000.5), std::sqrt(2.0L) * 0x1p1000L), 4e-16);
}

TEST(Math, PowKeepsItsLimits) {
  EXPECT_EQ(pow(0, 2.4), 0);
  EXPECT_EQ(pow(0, 0), 1);
  EXPECT_EQ(pow(0, -1), kInfinity);
  EXPECT_EQ(pow(1, kInfinity), 1);
  EXPECT_EQ(pow(2, 1024), kInfinity);
  EXPECT_EQ(pow(2, -1080), 0);
  EXPECT_EQ(pow(0.5, kInfinity), 0);
  EXPECT_EQ(pow(kInfinity, -2), 0);
  EXPECT_EQ(pow(2, -1074), 0x1p-1074);
  EXPECT_EQ(pow(3, 4), 81);
  EXPECT_TRUE(std::isnan(pow(-1, 2)));
  EXPECT_TRUE(std::isnan(pow(2, std::nan(""))));
}

TEST(Math, Atan2AgreesInAllQuadrants) {
  const auto error = [](double turn) {
    const double radius = 1 + 1000 * std::fabs(turn - std::floor(turn));
    const double x = radius * std::cos(turn), y = radius * std::sin(turn);
    return relativeError(atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
  };
  EXPECT_LT(largestError(-4, 4, kSamples, error), 5e-16);
  for (const double y : {0.0, -0.0, 1.0, -1.0, 1e-300}) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, 1e300}) {
      EXPECT_DOUBLE_EQ(atan2(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(atan2(y, x)), std::signbit(std::atan2(y, x)));
    }
  }
  EXPECT_TRUE(std::isnan(atan2(std::nan(""), 1)));
  EXPECT_TRUE(std::isnan(atan2(1, std::nan(""))));
}

TEST(Math, AcosAgreesUpToItsEnds) {
  const auto error = [](double x) { return relativeError(acos(x), std::acos(static_cast<long double>(x))); };
  EXPECT_LT(largestError(-1, 1, kSamples, error), 1e-15);
  EXPECT_LT(largestError(1 - 1e-9, 1, kSamples, error), 1e-15);
  EXPECT_EQ(acos(1), 0);
  EXPECT_EQ(acos(1.0000001), 0);
  EXPECT_DOUBLE_EQ(acos(-1.0000001), static_cast<double>(kPi));
  EXPECT_TRUE(std::isnan(acos(std::nan(""))));
}

TEST(Srgb, TableIsTheStandardsCurve) {
  for (int i = 0; i < 256; ++i) {
    const double code = i / 255.0;
    const double exact = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    EXPECT_FLOAT_EQ(srgbToLinear(static_cast<std::uint8_t>(i)), static_cast<float>(exact));
  }
}

TEST(Srgb, EncodingUndoesDecodingAndClamps) {
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(srgbByte(static_cast<double>(srgbToLinear(static_cast<std::uint8_t>(i)))), i);
  }
  // The standard's two pieces meet to within 3e-8 in code.
  const auto error = [](double x) { return std::fabs(linearToSrgb(srgbToLinear(x)) - x); };
  EXPECT_LT(largestError(0, 1, kSamples, error), 1e-7);
  EXPECT_EQ(linearToSrgb(-1), 0);
  EXPECT_EQ(linearToSrgb(2), 1);
  EXPECT_EQ(srgbByte(std::nan("")), 0);
}

}  // namespace
}  // namespace lucarne::math_test
