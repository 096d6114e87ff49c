// What tests ask of pictures.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/image_file.h"

namespace lucarne::test {

inline double meanOf(const ImageRgb& image) {
  double sum = 0;
  for (const Rgb& p : image.pixels) sum += mean(p);
  return sum / static_cast<double>(image.pixels.size());
}

inline double largestDifference(const ImageRgb& a, const ImageRgb& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgb d = a.pixels[i] - b.pixels[i];
    largest = std::max<double>(largest, std::max(maxComponent(d), -minComponent(d)));
  }
  return largest;
}

}  // namespace lucarne::test
