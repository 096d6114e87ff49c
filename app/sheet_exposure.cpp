#include "app/sheet_exposure.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/units.h"

namespace lucarne {
namespace {

constexpr double kMiddleGrey = 0.18, kDarkest = 1e-4;

}  // namespace

SheetExposure::SheetExposure(std::vector<double> luminances) {
  std::erase_if(luminances, [](double l) { return !(l > 0) || !std::isfinite(l); });
  if (luminances.empty()) return;
  const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(luminances.size() - 1));
  std::nth_element(luminances.begin(), luminances.begin() + rank, luminances.end());
  white_ = luminances[static_cast<std::size_t>(rank)];
  double sum = 0, count = 0;
  for (const double l : luminances) {
    if (l < white_ * kDarkest) continue;
    sum += std::log(std::min(l, white_));
    ++count;
  }
  grey_ = std::exp(sum / count);
}

DisplayColour SheetExposure::operator()(Rgbd light) const {
  const double l = luminance(light), x = std::min(l, white_) * kMiddleGrey / grey_, w = white_ * kMiddleGrey / grey_;
  if (!(l > 0)) return {0, 0, 0};
  const Rgbd shown = light * (x * (1 + x / (w * w)) / (1 + x) / l);
  return {srgbByte(shown.x), srgbByte(shown.y), srgbByte(shown.z)};
}

std::string SheetExposure::words() const {
  return "grey " + formatNumber(grey_) + " lx, white " + formatNumber(white_) + " lx";
}

}  // namespace lucarne
