#include "tracer/optics/environment.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <span>

#include "base/error.h"
#include "base/math.h"
#include "tracer/optics/cumulative.h"

namespace lucarne {
namespace {


/// Rounding a direction to floats turns it by less than this, about its azimuth as well as away from the pole.
constexpr double kRoundingAngle = 2e-7;

/// Smaller numbers count as 0: whether a thread flushes denormals must not matter.
constexpr float kSmallest = std::numeric_limits<float>::min();

bool isStray(Rgb pixel) { return !isFinite(pixel) || minComponent(pixel) <= -kSmallest; }

float usable(float value, float largest) { return value >= kSmallest ? std::min(value, largest) : 0; }

float largestFinite(std::span<const Rgb> row) {
  float largest = 0;
  for (const Rgb& pixel : row)
    for (int c = 0; c < 3; ++c)
      if (std::isfinite(pixel[c]) && pixel[c] >= kSmallest) largest = std::max(largest, pixel[c]);
  return largest;
}

/// Index of the one of n equal pieces of [0, 1] that x lies in.
std::size_t pieceOf(double x, int n) {
  const double scaled = x * n;
  return scaled >= 0 ? std::min(static_cast<std::size_t>(scaled), static_cast<std::size_t>(n - 1)) : 0;
}

/// A number in [0, 1) moved off both ends, so that the direction stays in its pixel of this angle when it is rounded.
double offBorders(double x, double pixelAngle) {
  const double hair = std::min(0.25, kRoundingAngle / pixelAngle);
  return hair + (1 - 2 * hair) * x;
}

}  // namespace

Environment::Environment(ImageRgb image, std::string name) : image_(std::move(image)), name_(std::move(name)) {
  if (image_.width < 1 || image_.height < 1) throw InputError(name_ + ": an environment without pixels is not usable");
  LUCARNE_CHECK_EQ(image_.pixels.size(),
                   static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height));
  replaceStrays();
  buildTables();
}

void Environment::replaceStrays() {
  const auto width = static_cast<std::size_t>(image_.width), height = static_cast<std::size_t>(image_.height);
  const auto row = [&](std::size_t y) { return std::span(image_.pixels).subspan(y * width, width); };
  std::vector<float> largest(height);
  tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) { largest[y] = largestFinite(row(y)); });
  const float top = *std::max_element(largest.begin(), largest.end());
  std::vector<std::size_t> strays(height);
  tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
    for (Rgb& pixel : row(y)) {
      if (isStray(pixel)) ++strays[y];
      pixel = {usable(pixel.x, top), usable(pixel.y, top), usable(pixel.z, top)};
    }
  });
  for (const std::size_t count : strays) strayPixels_ += count;
}

void Environment::buildTables() {
  const auto width = static_cast<std::size_t>(image_.width), height = static_cast<std::size_t>(image_.height);
  for (int y = 0; y <= image_.height; ++y) cosines_.push_back(cosPi(static_cast<double>(y) / image_.height));
  columns_.resize(width * height);
  columnGuide_.resize(width * height);
  rows_.resize(height);
  rowGuide_.resize(height);
  std::vector<Rgbd> sums(height);  // in one thread's order within a row and over the rows: the same bits always
  tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
    const std::span<double> weights = std::span(columns_).subspan(y * width, width);
    Rgbd sum;
    for (std::size_t x = 0; x < width; ++x) {
      const Rgbd pixel(image_.pixels[y * width + x]);
      sum += pixel;
      weights[x] = mean(pixel);
    }
    sums[y] = sum;
    rows_[y] = makeCumulative(weights) * pixelSolidAngle(static_cast<int>(y));
    makeGuide(weights, std::span(columnGuide_).subspan(y * width, width));
  });
  for (std::size_t y = 0; y < height; ++y) scalarIrradiance_ += sums[y] * pixelSolidAngle(static_cast<int>(y));
  total_ = makeCumulative(rows_);
  makeGuide(rows_, rowGuide_);
}

Environment::Sample Environment::sample(double u, double v) const {
  LUCARNE_CHECK_LT(0.0, total_);
  const auto width = static_cast<std::size_t>(image_.width);
  const Choice row = choose(rows_, rowGuide_, v);
  const std::size_t first = row.index * width;
  const Choice column =
      choose(std::span(columns_).subspan(first, width), std::span(columnGuide_).subspan(first, width), u);
  // Uniform in the azimuth and in the cosine: uniform in solid angle.
  const double down = offBorders(row.rest, kPiD / image_.height);
  const double across = offBorders(column.rest, 2 * kPiD / image_.width);
  const double y = cosines_[row.index] + (cosines_[row.index + 1] - cosines_[row.index]) * down;
  const double sine = std::sqrt(std::max(0.0, (1 - y) * (1 + y)));
  const double halfTurns = 2 * (static_cast<double>(column.index) + across) / image_.width - 1;
  const Rgb radiance = image_.pixels[first + column.index];
  return {Vec3f(Vec3d(sine * cosPi(halfTurns), y, sine * sinPi(halfTurns))), radiance, pdfOf(radiance)};
}

std::size_t Environment::pixelAt(Vec3f direction) const {
  const Vec3d d(direction);
  // The angle from the pole by both its sine and its cosine: the cosine alone loses it near the poles.
  const double fromPole = atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
  const std::size_t row = pieceOf(fromPole / kPiD, image_.height);
  const std::size_t column = pieceOf(atan2(d.z, d.x) / (2 * kPiD) + 0.5, image_.width);
  return row * static_cast<std::size_t>(image_.width) + column;
}

Rgbd Environment::meanRadiance() const { return scalarIrradiance_ * (1 / (4 * kPiD)); }

double Environment::pixelSolidAngle(int row) const {
  // cos a − cos b = 2 sin((a+b)/2) sin((b−a)/2), which does not cancel near the poles.
  return 4 * kPiD / image_.width * sinPi(0.5 / image_.height) * sinPi((row + 0.5) / image_.height);
}

Hash128 Environment::contentHash() const {
  Hasher hasher;
  hasher.addNumber(static_cast<std::uint64_t>(image_.width));
  hasher.addNumber(static_cast<std::uint64_t>(image_.height));
  hasher.add(std::as_bytes(std::span(image_.pixels)));
  return hasher.finish();
}

}  // namespace lucarne
