// Environment maps made for tests.
#pragma once

#include <cmath>
#include <random>

#include "base/image_file.h"

namespace lucarne::test {

inline ImageRgb constantMap(int width, int height, Rgb value) {
  return {width, height, std::vector<Rgb>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value)};
}

/// Where the sun of sunMap stands: off the middle, in the upper half.
inline std::size_t sunPixel(int width, int height) {
  return static_cast<std::size_t>(height / 3) * static_cast<std::size_t>(width) + static_cast<std::size_t>(width / 5);
}

/// Random colours between 0 and 2, some black, and one pixel of `peak` times their mean.
inline ImageRgb sunMap(int width, int height, double peak = 1e5) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> colour(0, 2);
  ImageRgb image = constantMap(width, height, Rgb(0));
  for (Rgb& pixel : image.pixels)
    if (random() % 4 != 0) pixel = Rgb(colour(random), colour(random), colour(random));
  const auto sun = static_cast<float>(peak);
  image.pixels[sunPixel(width, height)] = Rgb(sun, 0.9f * sun, 0.8f * sun);
  return image;
}

/// Toward the centre of a pixel, by the C library.
inline Vec3f pixelCentre(double x, double y, int width, int height) {
  constexpr double kPi64 = 3.14159265358979323846;
  const double azimuth = 2 * kPi64 * ((x + 0.5) / width - 0.5), polar = kPi64 * (y + 0.5) / height;
  return Vec3f(Vec3d(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)));
}

}  // namespace lucarne::test
