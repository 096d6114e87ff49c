#include "dlm/texel_error.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"

namespace lucarne {

std::uint8_t ErrorRatios::classOf(double photons) {
  constexpr std::uint8_t kLast = std::tuple_size_v<decltype(classes_)> - 1;
  std::uint8_t c = 0;
  for (double most = 4 * kEnoughPhotons; photons >= most && c < kLast; most *= 4) ++c;
  return c;
}

ErrorRatios& ErrorRatios::operator+=(const ErrorRatios& o) {
  for (std::size_t c = 0; c < classes_.size(); ++c) classes_[c] += o.classes_[c];
  return *this;
}

ErrorRatio ErrorRatios::total() const {
  ErrorRatio sum;
  for (const ErrorRatio& c : classes_) sum += c;
  return sum;
}

double errorRatio(const ErrorRatios& side, const ErrorRatios& all, std::size_t photonClass) {
  // As many texels as outweigh what is believed without them.
  constexpr double kOfAll = 32, kOfSome = 16;
  const auto told = [](const ErrorRatio& r, double believed, double weight) {
    return (r.squares + weight * believed) / (r.texels + weight);
  };
  const double whole = told(all.total(), 1, kOfAll);
  const double ofClass = told(all[photonClass], whole, kOfSome), ofSide = told(side.total(), whole, kOfSome);
  return told(side[photonClass], ofSide * ofClass / whole, kOfSome);
}

ErrorRatios measureErrorRatios(std::span<const double> differences, std::span<const double> variances,
                               std::span<const double> photons, double overlap) {
  ErrorRatios ratios;
  for (std::size_t t = 0; t < differences.size(); ++t) {
    if (photons[t] < kEnoughPhotons || !(variances[t] > 0)) continue;
    ratios[ErrorRatios::classOf(photons[t])] += {differences[t] * differences[t] / variances[t] / overlap, 1 / overlap};
  }
  return ratios;
}

NeighbourSquares::NeighbourSquares(int width, int height, std::span<const double> photons,
                                   std::span<const double> squares, std::span<const double> area)
    : width_(width), height_(height) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  LUCARNE_CHECK_EQ(area.size(), w * h);
  table_.resize((w + 1) * (h + 1));
  // Sums of whole numbers are exact, so that a window without surface has none: with those of fractions, what rounding
  // left in its place would be divided by.
  const double largest = area.empty() ? 0 : *std::max_element(area.begin(), area.end());
  areaUnit_ = largest > 0 ? largest * 0x1p-30 : 1;
  for (std::size_t y = 0; y < h; ++y) {
    Sums row;
    for (std::size_t x = 0; x < w; ++x) {
      const std::size_t t = y * w + x;
      const double open = std::round(area[t] / areaUnit_);
      // What fell where no surface is open says nothing about the surface around it.
      if (open > 0) row = {row.photons + photons[t], row.squares + squares[t], row.area + open};
      const Sums& above = table_[y * (w + 1) + x + 1];
      table_[(y + 1) * (w + 1) + x + 1] = {above.photons + row.photons, above.squares + row.squares,
                                           above.area + row.area};
    }
  }
}

NeighbourSquares::Sums NeighbourSquares::window(int x, int y, int radius) const {
  const auto at = [&](int u, int v) -> const Sums& {
    return table_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(u)];
  };
  const int left = std::max(0, x - radius), right = std::min(width_, x + radius + 1);
  const int top = std::max(0, y - radius), bottom = std::min(height_, y + radius + 1);
  const Sums &a = at(left, top), &b = at(right, top), &c = at(left, bottom), &d = at(right, bottom);
  return {d.photons - b.photons - c.photons + a.photons, d.squares - b.squares - c.squares + a.squares,
          d.area - b.area - c.area + a.area};
}

double NeighbourSquares::density(int x, int y, int smallestRadius) const {
  for (int radius = std::max(1, smallestRadius);; radius *= 2) {
    const Sums sums = window(x, y, radius);
    const bool whole = radius >= std::max(width_, height_);
    if (sums.photons < kEnoughPhotons && !whole) continue;
    return sums.area > 0 && sums.squares > 0 ? sums.squares / (sums.area * areaUnit_) : 0;
  }
}

}  // namespace lucarne
