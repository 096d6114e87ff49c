#include <cmath>

#include "base/math.h"

namespace lucarne {
namespace {

std::array<float, 256> makeDecodeTable() {
  std::array<float, 256> table{};
  for (std::size_t code = 0; code < table.size(); ++code) {
    table[code] = static_cast<float>(srgbToLinear(static_cast<double>(code) / 255));
  }
  return table;
}

}  // namespace

double srgbToLinear(double code) { return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4); }

float srgbToLinear(std::uint8_t code) {
  static const std::array<float, 256> table = makeDecodeTable();
  return table[code];
}

double linearToSrgb(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

std::uint8_t srgbByte(double linear) { return static_cast<std::uint8_t>(255 * linearToSrgb(linear) + 0.5); }

}  // namespace lucarne
