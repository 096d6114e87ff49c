#include "dlm/side_errors.h"

#include <cmath>

namespace lucarne {
namespace {

constexpr double kUnit = 1 / static_cast<double>(kFixedPointOne);

std::vector<double> channelOf(std::span<const std::int64_t> statistics, std::uint64_t channel) {
  std::vector<double> values(statistics.size() / kStatisticsChannels);
  for (std::size_t t = 0; t < values.size(); ++t)
    values[t] = static_cast<double>(statistics[kStatisticsChannels * t + channel]);
  return values;
}

/// Luminance of each texel, all directions together, in units.
std::vector<double> luminanceUnits(const SideInput& s, const Tallies& set) {
  std::vector<double> sums(s.side.texelCount());
  for (std::uint64_t k = 0; k < s.in.tallyLayout.membersOf(s.side).mapCount(); ++k) {
    const auto units = mapUnits(set, s.side, k);
    for (std::size_t t = 0; t < sums.size(); ++t) {
      const std::int64_t* p = units.data() + kLightChannels * t;
      sums[t] += luminance(Rgbd{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    }
  }
  return sums;
}

/// How many texels share their photons: one over the share of its photons that a texel has to itself.
double overlapOf(const Kernel& kernel) {
  double sum = 0, squares = 0;
  for (const double k : kernel.weights) {
    sum += k;
    squares += k * k;
  }
  const double along = sum * sum / squares;
  return along * along;
}

std::vector<float> deviationsOf(const std::vector<double>& variances) {
  std::vector<float> deviations;
  for (const double v : variances) deviations.push_back(static_cast<float>(std::sqrt(std::max(0.0, v))));
  return deviations;
}

std::vector<std::uint8_t> classesOf(const std::vector<double>& photons) {
  std::vector<std::uint8_t> classes;
  for (const double n : photons) classes.push_back(ErrorRatios::classOf(n));
  return classes;
}

/// Luminance of a texel's samples times its area, lx: what filters take.
std::vector<double> luxOf(const SideInput& s, std::vector<double> units) {
  for (std::size_t t = 0; t < units.size(); ++t) units[t] *= s.area()[t] * s.scales.direct;
  return units;
}

/// Σ k²·Σx² over (Σ k·area)², in squares of units: from the texels' own photons, and where those are few from their
/// neighbours' instead.
std::vector<double> squaresUnderKernel(const SideInput& s, const std::vector<double>& photonsUnderKernel) {
  const auto statistics = statisticsOf(s.in.tallies, s.side);
  const std::vector<double> squares = channelOf(statistics, kSquares);
  const std::vector<double> open = s.openArea();
  const NeighbourSquares neighbours(s.side.width, s.side.height, channelOf(statistics, kCount), squares, open);
  std::vector<double> own = s.resolver.filterSquares(squares);
  const std::vector<double> spread = s.resolver.filterSquares(open);
  for (std::size_t t = 0; t < own.size(); ++t) {
    const double share = neighbourShare(photonsUnderKernel[t]);
    if (share < 1e-3) continue;
    const int x = static_cast<int>(t) % s.side.width, y = static_cast<int>(t) / s.side.width;
    own[t] += share * (neighbours.density(x, y, s.kernel.radius) * spread[t] - own[t]);
  }
  return own;
}

/// Of a sum of N independent photons: Var(Σx) ≈ (Σx² − (Σx)²/N)·N/(N − 1), luminance, lx². One photon tells nothing
/// about its spread; it is taken for one of many.
std::vector<double> photonVariances(const SideInput& s, const std::vector<Rgbd>& irradiance,
                                    const std::vector<double>& photonsUnderKernel) {
  std::vector<double> squares = squaresUnderKernel(s, photonsUnderKernel);
  const double n = static_cast<double>(s.in.photons);
  for (std::size_t t = 0; t < squares.size(); ++t) {
    const double e = luminance(irradiance[t]);
    // The scale turns units into lx; m2 holds squares of fractions in units, so one factor of 2^24 less.
    const double square = squares[t] * s.scales.photons * s.scales.photons / kUnit;
    squares[t] = s.in.photons > 1 ? (square - e * e / n) * (n / (n - 1)) : square;
  }
  return squares;
}

SetErrors photonErrors(const SideInput& s, const std::vector<Rgbd>& irradiance) {
  const auto statistics = statisticsOf(s.in.tallies, s.side);
  const std::vector<double> photons = s.resolver.sumUnderKernel(channelOf(statistics, kCount));
  const std::vector<double> variances = photonVariances(s, irradiance, photons);
  std::vector<double> differences = luminanceUnits(s, s.in.tallies);
  const std::vector<double> odd = channelOf(statistics, kOdd);
  for (std::size_t t = 0; t < odd.size(); ++t) differences[t] = (differences[t] - 2 * odd[t]) * s.scales.photons;
  differences = s.resolver.filterDifferences(differences);
  return {deviationsOf(variances), classesOf(photons),
          measureErrorRatios(differences, variances, photons, overlapOf(s.kernel))};
}

/// Of a texel's mean over N samples: (Σx²/N − mean²)/(N − 1), luminance, weighted as resolve.h weights the means. lx².
std::vector<double> directVariances(const SideInput& s, const std::vector<double>& units) {
  const std::vector<double> squares = channelOf(statisticsOf(*s.in.tallies.direct(), s.side), kSquares);
  const double n = static_cast<double>(s.in.samples), unit = s.scales.direct * n / kUnit;
  std::vector<double> terms(units.size());
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const double mean = units[t] * kUnit / n, square = squares[t] * kUnit / n;
    const double variance = s.in.samples > 1 ? std::max(0.0, square - mean * mean) / (n - 1) : square;
    terms[t] = s.area()[t] * s.area()[t] * variance * unit * unit;
  }
  return s.resolver.filterSquares(terms);
}

/// The means of the two halves, n and N − n samples, differ by a variance of N/(n·(N − n)) times that of a sample, the
/// mean of all has 1/N of it.
SetErrors directErrors(const SideInput& s) {
  const std::vector<double> units = luminanceUnits(s, *s.in.tallies.direct());
  const std::vector<double> variances = directVariances(s, units);
  // A texel's samples are as good as so many photons.
  std::vector<double> worth = s.resolver.filterValues(luxOf(s, units));
  for (std::size_t t = 0; t < worth.size(); ++t)
    worth[t] = variances[t] > 0 ? std::max(kEnoughPhotons, worth[t] * worth[t] / variances[t]) : 0;
  SetErrors errors{deviationsOf(variances), classesOf(worth), {}};
  const double odd = static_cast<double>(s.in.oddSamples), even = static_cast<double>(s.in.samples) - odd;
  if (!(odd > 0 && even > 0)) return errors;
  std::vector<double> differences = channelOf(statisticsOf(*s.in.tallies.direct(), s.side), kOdd);
  const double scale = std::sqrt(odd * even) * s.scales.direct;
  for (std::size_t t = 0; t < differences.size(); ++t)
    differences[t] = ((units[t] - differences[t]) / even - differences[t] / odd) * scale * s.area()[t];
  errors.ratios =
      measureErrorRatios(s.resolver.filterDifferences(differences), variances, worth, overlapOf(s.kernel));
  return errors;
}

}  // namespace

std::vector<float> SideErrors::deviations(const ErrorRatios& allPhotons, const ErrorRatios& allDirect) const {
  std::vector<float> all(std::max(photons.deviations.size(), direct.deviations.size()));
  for (const auto& [set, sum] : {std::pair{&photons, &allPhotons}, {&direct, &allDirect}}) {
    std::array<float, 256> factor{};
    for (const std::uint8_t c : set->photonClasses)
      if (factor[c] == 0) factor[c] = static_cast<float>(std::sqrt(errorRatio(set->ratios, *sum, c)));
    for (std::size_t t = 0; t < set->deviations.size(); ++t)
      all[t] = std::hypot(all[t], factor[set->photonClasses[t]] * set->deviations[t]);
  }
  return all;
}

LevelEstimate estimateOf(const SideInput& s) {
  LevelEstimate estimate{std::vector<double>(s.side.texelCount()), std::vector<double>(s.side.texelCount())};
  if (s.in.photons > 0) {
    std::vector<Rgbd> irradiance;
    for (const double v : s.resolver.filterValues(luminanceUnits(s, s.in.tallies)))
      irradiance.emplace_back(v * s.scales.photons);
    const std::vector<double> photons = s.resolver.sumUnderKernel(channelOf(statisticsOf(s.in.tallies, s.side), kCount));
    estimate.variance = photonVariances(s, irradiance, photons);
    for (std::size_t t = 0; t < irradiance.size(); ++t) estimate.value[t] = irradiance[t].y;
  }
  if (s.in.samples == 0) return estimate;
  const std::vector<double> units = luminanceUnits(s, *s.in.tallies.direct());
  const std::vector<double> variances = directVariances(s, units);
  const std::vector<double> values = s.resolver.filterValues(luxOf(s, units));
  for (std::size_t t = 0; t < units.size(); ++t) {
    estimate.value[t] += values[t];
    estimate.variance[t] = std::max(0.0, estimate.variance[t]) + variances[t];
  }
  return estimate;
}

SideErrors sideErrors(const SideInput& s, const std::vector<Rgbd>& photonIrradiance) {
  SideErrors errors;
  if (s.in.photons > 0) errors.photons = photonErrors(s, photonIrradiance);
  if (s.in.samples > 0) errors.direct = directErrors(s);
  return errors;
}

}  // namespace lucarne
