#include "player/display_image.h"

#include <algorithm>
#include <cmath>

#include "base/heat_colour.h"
#include "base/units.h"

namespace lucarne {
namespace {

DisplayedImage displayLight(const ImageRgb& image, const DisplayOptions& options) {
  const float exposure = options.ev100 ? static_cast<float>(exposureOfEv100(*options.ev100)) : autoExposure(image);
  const double ev100 = ev100OfExposure(static_cast<double>(exposure));
  return {toDisplay(image, exposure, options.curve), "exposure value " + formatNumber(ev100), ev100};
}

DisplayedImage displayNumbers(const ImageRgb& image) {
  const float top = heatTop(image);
  DisplayedImage out{{}, "black 0 to pale yellow " + formatNumber(static_cast<double>(top)), 0};
  out.bytes.reserve(image.pixels.size() * 3);
  for (const Rgb& p : image.pixels) {
    const auto colour = heatColour(static_cast<double>(p.x / top));
    out.bytes.insert(out.bytes.end(), colour.begin(), colour.end());
  }
  return out;
}

}  // namespace

float heatTop(const ImageRgb& image) {
  constexpr double kShare = 0.99;
  std::vector<float> values;
  for (const Rgb& p : image.pixels) {
    if (p.x > 0 && std::isfinite(p.x)) values.push_back(p.x);
  }
  if (values.empty()) return 1.f;
  const auto rank = static_cast<std::ptrdiff_t>(static_cast<double>(values.size() - 1) * kShare);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

DisplayedImage displayImage(const ImageRgb& image, ViewScale scale, const DisplayOptions& options) {
  switch (scale) {
    case ViewScale::number:
      return displayNumbers(image);
    case ViewScale::colour:
      return {toDisplay(image, 1.f, ToneCurve::plain), "", 0};
    case ViewScale::light:
      break;
  }
  return displayLight(image, options);
}

}  // namespace lucarne
