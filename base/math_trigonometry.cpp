// sin, cos, atan2 and acos. Polynomials and the breakpoints of atan are those of fdlibm (Sun Microsystems, 1993),
// k_sin.c, k_cos.c and s_atan.c.
#include <cmath>
#include <limits>

#include "base/math.h"

namespace lucarne {
namespace {


/// sin(x), |x| ≤ π/4.
double sinKernel(double x) {
  const double z = x * x;
  const double r =
      8.33333333332248946124e-03 +
      z * (-1.98412698298579493134e-04 +
           z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  return x + z * x * (-1.66666666666666324348e-01 + z * r);
}

/// cos(x), |x| ≤ π/4. 1 − z/2 is split into its rounded value and the remainder, which is exact.
double cosKernel(double x) {
  const double z = x * x;
  const double r = z * (4.16666666666666019037e-02 +
                        z * (-1.38888888888741095749e-03 +
                             z * (2.48015872894767294178e-05 +
                                  z * (-2.75573143513906633035e-07 +
                                       z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11)))));
  const double half = 0.5 * z, head = 1 - half;
  return head + ((1 - head - half) + z * r);
}

/// sin(π(x + quarters/2)) for x ≥ 0. Taking off whole turns and then quarters is exact.
double sinOfHalfTurns(double x, int quarters) {
  if (!(x < std::numeric_limits<double>::infinity())) return std::numeric_limits<double>::quiet_NaN();
  const double turn = x - 2 * std::floor(0.5 * x);
  const int nearest = static_cast<int>(2 * turn + 0.5);
  const double r = kPiD * (turn - 0.5 * nearest);
  const int quarter = (nearest + quarters) & 3;
  const double value = (quarter & 1) != 0 ? cosKernel(r) : sinKernel(r);
  return (quarter & 2) != 0 ? 0 - value : value;
}

/// An angle as the sum of two doubles.
struct Angle {
  double hi, lo;
};

/// atan(t), 0 ≤ t ≤ 1: the angle of the nearest of 0, 1/2, 1, and the rest by a polynomial in the tangent of the
/// difference.
double atanUnit(double t) {
  Angle base{0, 0};
  double x = t;
  if (t >= 11.0 / 16) {
    base = {7.85398163397448278999e-01, 3.06161699786838301793e-17};
    x = (t - 1) / (t + 1);
  } else if (t >= 7.0 / 16) {
    base = {4.63647609000806093515e-01, 2.26987774529616870924e-17};
    x = (2 * t - 1) / (2 + t);
  }
  constexpr double kA[] = {3.33333333333329318027e-01,  -1.99999999998764832476e-01, 1.42857142725034663711e-01,
                           -1.11111104054623557880e-01, 9.09088713343650656196e-02,  -7.69187620504482999495e-02,
                           6.66107313738753120669e-02,  -5.83357013379057348645e-02, 4.97687799461593236017e-02,
                           -3.65315727442169155270e-02, 1.62858201153657823623e-02};
  const double z = x * x;
  double r = 0;
  for (int i = 10; i >= 0; --i) r = kA[i] + z * r;
  return base.hi - ((x * z * r - base.lo) - x);
}

}  // namespace

double sinPi(double x) { return std::copysign(1.0, x) * sinOfHalfTurns(std::fabs(x), 0); }

double cosPi(double x) { return sinOfHalfTurns(std::fabs(x), 1); }

double atan2(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (!(ax <= ay) && !(ay <= ax)) return x + y;  // NaN
  const double larger = ax > ay ? ax : ay;
  double angle = larger > 0 ? atanUnit((ax > ay ? ay : ax) / larger) : 0;
  constexpr double kHalfPiLow = 6.12323399573676603587e-17;
  if (ay > ax) angle = (0.5 * kPiD - angle) + kHalfPiLow;
  if (std::signbit(x)) angle = (kPiD - angle) + 2 * kHalfPiLow;
  return std::copysign(angle, y);
}

double acos(double x) {
  const double clamped = x > 1 ? 1 : x < -1 ? -1 : x;
  return 2 * atan2(std::sqrt(1 - clamped), std::sqrt(1 + clamped));
}

}  // namespace lucarne
