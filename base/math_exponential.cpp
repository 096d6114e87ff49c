// exp, log, pow and cbrt. Polynomials of fdlibm (Sun Microsystems, 1993), e_exp.c and e_log.c.
#include <cmath>
#include <limits>

#include "base/math.h"

namespace lucarne {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// ln 2 as a sum whose first term has so few digits that its products with exponents are exact.
constexpr double kLn2High = 6.93147180369123816490e-01, kLn2Low = 1.90821492927058770002e-10;

/// Nearest integer for |x| < 2^51: the sum has no bits left for a fraction.
double nearest(double x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 · 2^52
  return (x + kShift) - kShift;
}

/// value · 2^k with one rounding, also where the result is subnormal or infinite. 0.5 < value < 2, |k| < 1100.
double scale(double value, int k) {
  if (k > 1000) return value * powerOfTwo(1000) * powerOfTwo(k - 1000);
  if (k < -1000) return value * powerOfTwo(k + 1000) * powerOfTwo(-1000);
  return value * powerOfTwo(k);
}

/// e^(hi − lo), |hi| ≤ ln2/2, |lo| small: 1 + r + r·c/(2 − c), where c is r less an even polynomial.
double expKernel(double hi, double lo) {
  const double r = hi - lo, t = r * r;
  const double c =
      r -
      t * (1.66666666666666019037e-01 +
           t * (-2.77777777770155933842e-03 +
                t * (6.61375632143793436117e-05 + t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))));
  return 1 - ((lo - r * c / (2 - c)) - hi);
}

/// e^x · 2^extra for a result in the range of double or just beyond.
double expTimesPowerOfTwo(double x, int extra) {
  constexpr double kInverseLn2 = 1.44269504088896338700;
  const double k = nearest(x * kInverseLn2);
  return scale(expKernel(x - k * kLn2High, k * kLn2Low), static_cast<int>(k) + extra);
}

/// A positive finite number as mantissa · 2^exponent, the mantissa within a factor √2 of 1.
struct Binary {
  double mantissa;
  int exponent;
};

Binary split(double x) {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {  // subnormal
    x *= powerOfTwo(54);
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  const double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffff) | 0x3ff0000000000000);  // [1, 2)
  constexpr double kSqrt2 = 1.4142135623730951;
  return mantissa > kSqrt2 ? Binary{0.5 * mantissa, exponent + 1} : Binary{mantissa, exponent};
}

/// log of mantissa · 2^exponent: with f = mantissa − 1 and s = f/(2 + f), log(1 + f) = f − f²/2 + s(f²/2 + R(s²)).
double logKernel(Binary x) {
  const double f = x.mantissa - 1, s = f / (2 + f), z = s * s;
  const double r = z * (6.666666666666735130e-01 +
                        z * (3.999999999940941908e-01 +
                             z * (2.857142874366239149e-01 +
                                  z * (2.222219843214978396e-01 +
                                       z * (1.818357216161805012e-01 +
                                            z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const double half = 0.5 * f * f;
  return x.exponent * kLn2High - ((half - (s * (half + r) + x.exponent * kLn2Low)) - f);
}

}  // namespace

double exp(double x) {
  if (!(x < 710)) return x >= 710 ? kInfinity : kNan;
  if (x < -746) return 0;
  return expTimesPowerOfTwo(x, 0);
}

double log(double x) {
  if (!(x > 0)) return x == 0 ? -kInfinity : kNan;
  if (x == kInfinity) return x;
  return logKernel(split(x));
}

// x^y = 2^(y·e) · m^y with x = m·2^e. y·e is split so that its integer part costs no accuracy: the head of y (26 bits)
// times e is exact, and so is the tail times e.
double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (!(x >= 0) || y != y) return kNan;
  if (x == 0 || x == kInfinity) return (x == 0) == (y > 0) ? 0 : kInfinity;
  const Binary binary = split(x);
  const double rough = y * logKernel(binary);
  if (rough > 710) return kInfinity;
  if (rough < -746) return 0;
  const double head = std::bit_cast<double>(std::bit_cast<std::uint64_t>(y) & ~std::uint64_t{0x7ffffff});
  const double headPower = head * binary.exponent, tailPower = (y - head) * binary.exponent;
  const double whole = nearest(headPower + tailPower);
  const double fraction = (headPower - whole) + tailPower;
  const double rest = fraction * 0.693147180559945309417 + y * logKernel({binary.mantissa, 0});
  return expTimesPowerOfTwo(rest, static_cast<int>(whole));
}

double cbrt(double x) {
  const double a = std::fabs(x);
  if (!(a > 0 && a < kInfinity)) return x;
  constexpr double kTiny = 1e-290, kHuge = 1e290;  // beyond, the iteration would leave the range: scale by 2^±54
  if (a < kTiny) return cbrt(x * powerOfTwo(54)) * powerOfTwo(-18);
  if (a > kHuge) return cbrt(x * powerOfTwo(-54)) * powerOfTwo(18);
  // A third of the exponent is right to 5 bits; Halley's step triples them. Newton's last step only adds a small
  // difference, so its rounding errors hardly count.
  double t = std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) / 3 + (std::uint64_t{715094163} << 32));
  for (int i = 0; i < 2; ++i) {
    const double cube = t * t * t;
    t *= (cube + 2 * a) / (2 * cube + a);
  }
  t -= (t - a / (t * t)) / 3;
  return std::copysign(t, x);
}

}  // namespace lucarne
