// Hypothesis tests on fixed streams: χ² with pooled sparse bins, and thresholds corrected for the number of questions.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace lucarne::test {

/// Upper regularised incomplete gamma function Q(a, x) (series and continued fraction; Abramowitz and Stegun 6.5).
inline double gammaQ(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-16; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    const double step = d * c;
    h *= step;
    if (std::abs(step - 1) < 1e-15) break;
  }
  return front * h;
}

/// p-value of observed counts against expected ones; bins expecting fewer than 5 are pooled. 0 when something was seen
/// where nothing may be.
inline double chiSquareP(const std::vector<double>& observed, const std::vector<double>& expected) {
  double chi = 0, pooledO = 0, pooledE = 0;
  int bins = 0;
  const auto add = [&](double o, double e) {
    chi += (o - e) * (o - e) / e;
    ++bins;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] >= 5) {
      add(observed[i], expected[i]);
    } else {
      if (expected[i] <= 0 && observed[i] > 0) return 0;
      pooledO += observed[i];
      pooledE += expected[i];
    }
  }
  if (pooledE >= 5) add(pooledO, pooledE);
  return bins > 1 ? gammaQ(0.5 * (bins - 1), 0.5 * chi) : 1;
}

/// |z| that `questions` independent standard normal values all stay under with probability 1 − significance (Šidák).
inline double zThreshold(std::uint64_t questions, double significance = 1e-4) {
  const double tail = -std::expm1(std::log1p(-significance) / static_cast<double>(questions));  // per question, two-sided
  double lo = 0, hi = 40;
  for (int i = 0; i < 200; ++i) {
    const double mid = 0.5 * (lo + hi);
    (std::erfc(mid / std::sqrt(2.0)) > tail ? lo : hi) = mid;
  }
  return hi;
}

}  // namespace lucarne::test
