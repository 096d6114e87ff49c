#include "player/tonemap.h"

#include <algorithm>
#include <cmath>

namespace lucarne {
namespace {

constexpr double kMiddleGrey = 0.18, kDarkest = 1e-4, kBrightShare = 0.01;

constexpr double kWhitePerEv = 1.2;  // cd/m² at EV 0

std::uint8_t toByte(float exposed, ToneCurve curve) {
  const float x = exposed > 0 ? std::min(exposed, 1e4f) : 0.f;  // NaN: 0
  const float shown = curve == ToneCurve::filmic ? filmic(x) : std::min(x, 1.f);
  return static_cast<std::uint8_t>(std::lround(255.f * encodeSrgb(shown)));
}

}  // namespace

float autoExposure(const ImageRgb& image) {
  std::vector<double> lit;
  for (const Rgb& p : image.pixels) {
    const double l = luminance(Rgbd(p));
    if (l > 0 && std::isfinite(l)) lit.push_back(l);
  }
  if (lit.empty()) return 1.f;
  const auto rank = static_cast<std::ptrdiff_t>(static_cast<double>(lit.size() - 1) * (1 - kBrightShare));
  std::nth_element(lit.begin(), lit.begin() + rank, lit.end());
  const double bright = lit[static_cast<std::size_t>(rank)];
  double sum = 0, count = 0;
  for (const double l : lit) {
    if (l < bright * kDarkest) continue;
    sum += std::log(std::min(l, bright));
    ++count;
  }
  const double exposure = kMiddleGrey / std::exp(sum / count);
  return static_cast<float>(std::clamp(exposure, 1e-30, 1e30));
}

float filmic(float x) { return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.f, 1.f); }

float encodeSrgb(float c) { return c > 0.0031308f ? 1.055f * std::pow(c, 1.f / 2.4f) - 0.055f : 12.92f * c; }

double exposureOfEv100(double ev100) { return 1 / (kWhitePerEv * std::exp2(ev100)); }
double ev100OfExposure(double exposure) { return -std::log2(kWhitePerEv * exposure); }

std::vector<std::uint8_t> toDisplay(const ImageRgb& image, float exposure, ToneCurve curve) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Rgb& p : image.pixels) {
    for (int i = 0; i < 3; ++i) bytes.push_back(toByte(p[i] * exposure, curve));
  }
  return bytes;
}

}  // namespace lucarne
