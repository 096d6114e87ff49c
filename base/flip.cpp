#include "base/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/flip_colour.h"
#include "base/flip_filters.h"

namespace lucarne {
namespace {

constexpr float kColourExponent = 0.7f;
constexpr float kKnee = 0.4f, kKneeError = 0.95f;  // differences up to 0.4 of the largest are spread over 0 … 0.95
constexpr int kMostExposures = 24;
constexpr double kMostStops = 126;  // of a float's exponent
constexpr double kShown = 0.85;     // of white: what the exposures are chosen for

/// What the eye gets of one picture.
struct Seen {
  Plane L, a, b;      // blurred colour
  Plane edge, point;  // strength of features
};

struct Filters {
  SensitivityFilters sensitivity;
  FeatureFilters features;
  explicit Filters(double pixelsPerDegree)
      : sensitivity(sensitivityFilters(pixelsPerDegree)), features(featureFilters(pixelsPerDegree)) {}
};

struct Opponent {
  Plane y, cx, cz;
};

Opponent opponentOf(const ImageRgb& image, float scale, bool tone) {
  Opponent out{Plane(image.width, image.height), Plane(image.width, image.height), Plane(image.width, image.height)};
  tbb::parallel_for(0, image.height, [&](int row) {
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(image.width); ++i) {
      Rgb c{};
      for (int k = 0; k < 3; ++k) {
        const float v = image.pixels[i][k];
        if (std::isfinite(v)) c[k] = tone ? flipToneCurve(v * scale) : std::clamp(v, 0.f, 1.f);
      }
      const Vec3f o = opponentFromRgb(c);
      out.y.values[i] = o.x, out.cx.values[i] = o.y, out.cz.values[i] = o.z;
    }
  });
  return out;
}

Plane blurred(const Plane& in, const Taps& taps) { return filterColumns(filterRows(in, taps), taps); }

void seeColour(const Opponent& o, const SensitivityFilters& f, Seen& seen) {
  seen.L = blurred(o.y, f.achromatic);
  seen.a = blurred(o.cx, f.redGreen);
  seen.b = blurred(o.cz, f.blueYellow1);
  const Plane second = blurred(o.cz, f.blueYellow2);
  tbb::parallel_for(0, seen.L.height, [&](int y) {
    float *L = seen.L.row(y), *a = seen.a.row(y), *b = seen.b.row(y);
    const float* b2 = second.row(y);
    for (int x = 0; x < seen.L.width; ++x) {
      const Rgb c = rgbFromOpponent({L[x], a[x], f.byFirst * b[x] + (1 - f.byFirst) * b2[x]});
      const Vec3f lab =
          huntLabFromRgb({std::clamp(c.x, 0.f, 1.f), std::clamp(c.y, 0.f, 1.f), std::clamp(c.z, 0.f, 1.f)});
      L[x] = lab.x, a[x] = lab.y, b[x] = lab.z;
    }
  });
}

/// |(along x, along y)| of one derivative.
Plane strength(const Plane& alongX, const Plane& alongY) {
  Plane out(alongX.width, alongX.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = std::sqrt(alongX.values[i] * alongX.values[i] + alongY.values[i] * alongY.values[i]);
  }
  return out;
}

void seeFeatures(const Opponent& o, const FeatureFilters& f, Seen& seen) {
  Plane y(o.y.width, o.y.height);
  for (std::size_t i = 0; i < y.values.size(); ++i) y.values[i] = (o.y.values[i] + 16) / 116;
  const Plane smooth = filterRows(y, f.smooth);
  seen.edge = strength(filterColumns(filterRows(y, f.edge), f.smooth), filterColumns(smooth, f.edge));
  seen.point = strength(filterColumns(filterRows(y, f.point), f.smooth), filterColumns(smooth, f.point));
}

Seen see(const Opponent& opponent, const Filters& filters) {
  Seen seen;
  seeColour(opponent, filters.sensitivity, seen);
  seeFeatures(opponent, filters.features, seen);
  return seen;
}

/// Colour differences, raised to 0.7, onto 0 … 1; green against blue is the largest that there is.
float colourError(float difference, float largest) {
  const float p = std::pow(difference, kColourExponent), knee = kKnee * largest;
  return p < knee ? kKneeError / knee * p : kKneeError + (p - knee) / (largest - knee) * (1 - kKneeError);
}

/// The colour error, raised the more the features differ, is kept in `error` where it is larger than what is there.
void keepLarger(const Seen& a, const Seen& b, FlipMap& map) {
  const float largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColourExponent);
  tbb::parallel_for(0, map.height, [&](int row) {
    const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(map.width); ++i) {
      const float colour = colourError(
          hyab({a.L.values[i], a.a.values[i], a.b.values[i]}, {b.L.values[i], b.a.values[i], b.b.values[i]}), largest);
      const float features = std::sqrt(
          std::max(std::abs(a.edge.values[i] - b.edge.values[i]), std::abs(a.point.values[i] - b.point.values[i])) *
          std::numbers::sqrt2_v<float> / 2);
      const float error = colour > 0 ? std::pow(colour, 1 - features) : 0.f;
      map.error[i] = std::max(map.error[i], std::clamp(error, 0.f, 1.f));
    }
  });
}

FlipMap blankMap(const ImageRgb& reference, const ImageRgb& test) {
  LUCARNE_CHECK_EQ(reference.width, test.width);
  LUCARNE_CHECK_EQ(reference.height, test.height);
  return {reference.width, reference.height, std::vector<float>(reference.pixels.size())};
}

}  // namespace

double FlipMap::mean() const {
  double sum = 0;
  for (const float e : error) sum += static_cast<double>(e);
  return error.empty() ? 0 : sum / static_cast<double>(error.size());
}

float FlipMap::largest() const { return error.empty() ? 0.f : *std::max_element(error.begin(), error.end()); }

FlipExposures flipExposures(const ImageRgb& reference) {
  std::vector<double> lit;
  std::size_t dark = 0;
  for (const Rgb& p : reference.pixels) {
    const double l = luminance(Rgbd(p));
    if (l > 0 && std::isfinite(l))
      lit.push_back(l);
    else
      ++dark;
  }
  if (lit.empty()) return {};
  std::sort(lit.begin(), lit.end());
  // The middle of all pixels, dark ones first; among the lit ones when that is dark.
  const std::size_t n = lit.size() + dark, upper = n / 2, lower = (n - 1) / 2;
  const bool isLit = lower >= dark;
  const double median = isLit ? 0.5 * (lit[upper - dark] + lit[lower - dark]) : lit[lit.size() / 2];
  const double exposed = inverseFlipToneCurve(kShown);
  FlipExposures e;
  const auto stops = [&](double l) { return std::clamp(std::log2(exposed / l), -kMostStops, kMostStops); };
  e.start = stops(lit.back());
  e.stop = stops(median);
  if (e.stop > e.start) e.count = std::clamp(static_cast<int>(std::ceil(e.stop - e.start)), 2, kMostExposures);
  return e;
}

FlipMap flipLdr(const ImageRgb& reference, const ImageRgb& test, double pixelsPerDegree) {
  FlipMap map = blankMap(reference, test);
  if (map.error.empty()) return map;
  const Filters filters(pixelsPerDegree);
  keepLarger(see(opponentOf(reference, 1, false), filters), see(opponentOf(test, 1, false), filters), map);
  return map;
}

FlipMap flipHdr(const ImageRgb& reference, const ImageRgb& test, const FlipExposures& exposures,
                double pixelsPerDegree) {
  FlipMap map = blankMap(reference, test);
  if (map.error.empty()) return map;
  const Filters filters(pixelsPerDegree);
  for (int i = 0; i < exposures.count; ++i) {
    const auto scale = static_cast<float>(std::exp2(exposures.at(i)));
    keepLarger(see(opponentOf(reference, scale, true), filters), see(opponentOf(test, scale, true), filters), map);
  }
  return map;
}

}  // namespace lucarne
